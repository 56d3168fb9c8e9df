// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

/// Memory as the system has it, in one unit for each: system_memory_linux.cpp, system_memory_windows.cpp;
/// what runs anywhere is system_memory_portable.cpp, where files are no memory.
namespace posewire::log {

/// A hint that this memory is large and used as a whole.
void useLargePages(std::byte* memory, std::size_t size);

/// A file whose pages are memory. It has no name that outlives the process. On Windows a handle, of which 32
/// bits are significant.
using MemoryFile = int;
inline constexpr MemoryFile kNoMemoryFile = -1;

/// In a folder that exists; kNoMemoryFile if none can be made.
[[nodiscard]] MemoryFile openMemoryFile(const std::string& folder);
void closeMemoryFile(MemoryFile file);

/// Lets the file grow by a segment at its end, `offset`, and maps that. Null if there is no room for it:
/// the disk has room for what was mapped, so that no access can fail.
[[nodiscard]] std::byte* mapSegment(MemoryFile file, std::uint64_t offset, std::size_t size);
void unmapSegment(std::byte* segment, std::size_t size);
/// It stays where it is, and in the memory of this process no longer than needed.
void letGo(std::byte* segment, std::size_t size);

} // namespace posewire::log
