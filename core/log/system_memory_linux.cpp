// SPDX-License-Identifier: MIT
#include "core/log/system_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace posewire::log {

void useLargePages(std::byte* memory, std::size_t size) {
    ::madvise(memory, size, MADV_HUGEPAGE); // if it is refused, ordinary pages do
}

MemoryFile openMemoryFile(const std::string& folder) {
    return ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
}

void closeMemoryFile(MemoryFile file) {
    ::close(file);
}

std::byte* mapSegment(MemoryFile file, std::uint64_t offset, std::size_t size) {
    if (::posix_fallocate(file, static_cast<off_t>(offset), static_cast<off_t>(size)) != 0) {
        return nullptr;
    }
    void* memory =
        ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, static_cast<off_t>(offset));
    return memory == MAP_FAILED ? nullptr : static_cast<std::byte*>(memory);
}

void unmapSegment(std::byte* segment, std::size_t size) {
    ::munmap(segment, size);
}

void letGo(std::byte* segment, std::size_t size) {
    ::madvise(segment, size, MADV_DONTNEED);
}

} // namespace posewire::log
