// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

/// Files as the system knows them, in one unit for each system: system_files_posix.cpp,
/// system_files_windows.cpp. Names are UTF-8. After a failure errno has the reason. Only for the units that
/// read and write files.
namespace posewire::log {

/// A file descriptor, closed with its owner.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : m_number(number) {}
    ~Descriptor();
    Descriptor(Descriptor&& other) noexcept : m_number(std::exchange(other.m_number, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(m_number, other.m_number);
        return *this;
    }

    [[nodiscard]] int number() const { return m_number; }
    [[nodiscard]] bool isOpen() const { return m_number >= 0; }

private:
    int m_number;
};

/// The kind and the identity of a file.
struct FileStatus {
    enum class Kind : std::uint8_t {
        File,
        Folder,
        Disk,  ///< as a device
        Stream ///< a pipe, a terminal, another device
    };
    Kind kind = Kind::Stream;
    std::uint64_t volume = 0; ///< equal, as is the number, for every name of a file
    std::uint64_t number = 0;
    std::uint64_t size = 0;
    std::uint64_t names = 1; ///< that lead to it; 0 once it was removed

    /// Bytes that can be lost.
    [[nodiscard]] bool holdsData() const { return kind == Kind::File || kind == Kind::Disk; }
    [[nodiscard]] bool isSameFileAs(const FileStatus& other) const {
        return volume == other.volume && number == other.number;
    }
};

/// Follows links.
[[nodiscard]] std::optional<FileStatus> statusOf(const std::string& path);
[[nodiscard]] std::optional<FileStatus> statusOf(int descriptor);

/// Opening a pipe without a writer does not wait: reading does.
[[nodiscard]] Descriptor openToRead(const std::string& path);
/// Fails with ENXIO for a pipe without a reader. Writing to a full one fails with EAGAIN. What is written to
/// a file comes at its end, wherever that is by then (not on Windows).
[[nodiscard]] Descriptor openToWrite(const std::string& path);
/// Fails with EEXIST if there is a file of that name. Permissions as chmod has them, if the system knows
/// them.
[[nodiscard]] Descriptor createToWrite(const std::string& path, unsigned mode);
[[nodiscard]] Descriptor duplicateOf(int descriptor);

/// The count of bytes read or written; 0 at the end, negative after a failure.
[[nodiscard]] std::ptrdiff_t readSome(const Descriptor& file, std::span<std::byte> into);
[[nodiscard]] std::ptrdiff_t readSomeAt(const Descriptor& file, std::uint64_t offset,
                                        std::span<std::byte> into);
[[nodiscard]] std::ptrdiff_t writeSome(int descriptor, std::span<const std::byte> bytes);

/// Waits `most` at most until reading or writing need not wait. An error counts as news: the next call
/// returns it. Always true if the system cannot tell.
[[nodiscard]] bool hasNews(const Descriptor& file, std::chrono::milliseconds most);
[[nodiscard]] bool hasRoom(int descriptor, std::chrono::milliseconds most);

/// Syncs what was written, if it lies on a disk.
[[nodiscard]] bool bringToDisk(const Descriptor& file);
/// Also syncs the directory entry, best effort.
void bringNameToDisk(const std::string& path);
[[nodiscard]] bool makeEmpty(const Descriptor& file);

/// Best effort: the folder may refuse a new file all the same.
[[nodiscard]] bool mayCreateIn(const std::string& folder);
/// Renames a file; fails with EEXIST if the new name is taken and may not be replaced.
[[nodiscard]] bool giveName(const std::string& from, const std::string& to, bool mayReplace);

/// Locks a file for as long as it is open. False, with EWOULDBLOCK, if another owner, in this process or any
/// other, has it locked. The lock ends with the process, however that ends.
[[nodiscard]] bool lockFile(const Descriptor& file);
/// Not open if the file is locked already, or cannot be opened.
[[nodiscard]] Descriptor openLocked(const std::string& path);

/// The ID of this process.
[[nodiscard]] std::uint64_t processNumber();

} // namespace posewire::log
