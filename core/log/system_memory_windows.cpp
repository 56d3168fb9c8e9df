// SPDX-License-Identifier: MIT
#include "core/log/system_memory.h"

#include "core/log/file_names.h"
#include "core/log/system_files.h"

#include <atomic>

#include <windows.h>

namespace posewire::log {
namespace {

HANDLE memoryHandle(MemoryFile file) {
    return reinterpret_cast<HANDLE>(static_cast<std::intptr_t>(file));
}

} // namespace

void useLargePages(std::byte*, std::size_t) {} // need a privilege that few have

/// Windows removes it with the last handle, however the process ends.
MemoryFile openMemoryFile(const std::string& folder) {
    static std::atomic<unsigned> next = 0;
    const std::string name =
        ".posewire-" + std::to_string(processNumber()) + '-' + std::to_string(++next) + ".scratch";
    const std::filesystem::path path = pathOf(folder) / pathOf(name);
    constexpr DWORD flags = FILE_ATTRIBUTE_TEMPORARY | FILE_ATTRIBUTE_HIDDEN | FILE_FLAG_DELETE_ON_CLOSE;
    const HANDLE file =
        ::CreateFileW(path.c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, CREATE_ALWAYS, flags, nullptr);
    return static_cast<MemoryFile>(reinterpret_cast<std::intptr_t>(file));
}

void closeMemoryFile(MemoryFile file) {
    ::CloseHandle(memoryHandle(file));
}

std::byte* mapSegment(MemoryFile file, std::uint64_t offset, std::size_t size) {
    LARGE_INTEGER end{};
    end.QuadPart = static_cast<LONGLONG>(offset + size);
    if (::SetFilePointerEx(memoryHandle(file), end, nullptr, FILE_BEGIN) == FALSE ||
        ::SetEndOfFile(memoryHandle(file)) == FALSE) {
        return nullptr;
    }
    const HANDLE mapping = ::CreateFileMappingW(memoryHandle(file), nullptr, PAGE_READWRITE,
                                                static_cast<DWORD>(end.HighPart), end.LowPart, nullptr);
    if (mapping == nullptr) {
        return nullptr;
    }
    void* memory = ::MapViewOfFile(mapping, FILE_MAP_READ | FILE_MAP_WRITE, static_cast<DWORD>(offset >> 32U),
                                   static_cast<DWORD>(offset & 0xffffffffU), size);
    ::CloseHandle(mapping); // the view holds it
    return static_cast<std::byte*>(memory);
}

void unmapSegment(std::byte* segment, std::size_t) {
    ::UnmapViewOfFile(segment);
}

/// Pages that are not locked leave the working set.
void letGo(std::byte* segment, std::size_t size) {
    ::VirtualUnlock(segment, size);
}

} // namespace posewire::log
