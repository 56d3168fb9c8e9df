// SPDX-License-Identifier: MIT
#include "core/log/system_memory.h"

namespace posewire::log {

void useLargePages(std::byte*, std::size_t) {}

MemoryFile openMemoryFile(const std::string&) {
    return kNoMemoryFile;
}

void closeMemoryFile(MemoryFile) {}

std::byte* mapSegment(MemoryFile, std::uint64_t, std::size_t) {
    return nullptr;
}

void unmapSegment(std::byte*, std::size_t) {}

void letGo(std::byte*, std::size_t) {}

} // namespace posewire::log
