// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

/// Files as the system knows them, in one unit for each system: system_files_posix.cpp,
/// system_files_windows.cpp. Names are UTF-8. Where something fails, errno says why. Only for the units that
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

/// What a name or a descriptor leads to.
struct FileStatus {
    enum class Kind : std::uint8_t {
        File,
        Folder,
        Disk,  ///< as a device
        Stream ///< a pipe, a terminal, another device
    };
    Kind kind = Kind::Stream;
    bool isPipe = false;      ///< with a name or without
    std::uint64_t volume = 0; ///< with the number the same for every name of a file
    std::uint64_t number = 0;
    std::uint32_t rights = 0; ///< as the system writes them, as are owner and group
    std::uint32_t owner = 0;
    std::uint32_t group = 0;

    /// Bytes that can be lost.
    [[nodiscard]] bool holdsData() const { return kind == Kind::File || kind == Kind::Disk; }
    [[nodiscard]] bool isSameFileAs(const FileStatus& other) const {
        return volume == other.volume && number == other.number;
    }
};

/// Of what a link leads to.
[[nodiscard]] std::optional<FileStatus> statusOf(const std::string& path);
[[nodiscard]] std::optional<FileStatus> statusOf(int descriptor);
/// Whether there is a link of that name, wherever it leads.
[[nodiscard]] bool isLink(const std::string& path);
/// What this process has open already, by a name that stands for it: writing goes on where others are.
[[nodiscard]] std::optional<int> descriptorNamed(std::string_view path);

/// Opening a pipe that nobody writes to does not wait: reading does.
[[nodiscard]] Descriptor openToRead(const std::string& path);
/// Fails with ENXIO where it is a pipe that nobody reads.
[[nodiscard]] Descriptor openToWrite(const std::string& path);
/// Fails with EEXIST where there is one.
[[nodiscard]] Descriptor createToWrite(const std::string& path);
[[nodiscard]] Descriptor duplicateOf(int descriptor);

/// How much was read or written; 0 where nothing comes any more, negative where that failed.
[[nodiscard]] std::ptrdiff_t readSome(const Descriptor& file, std::span<std::byte> into);
[[nodiscard]] std::ptrdiff_t readSomeAt(const Descriptor& file, std::uint64_t offset,
                                        std::span<std::byte> into);
[[nodiscard]] std::ptrdiff_t writeSome(int descriptor, std::span<const std::byte> bytes);

/// Whether reading or writing need not wait, as known after so long at most. An error counts as news: the
/// next call says what it is. Where the system cannot tell it is true.
[[nodiscard]] bool hasNews(const Descriptor& file, std::chrono::milliseconds most);
[[nodiscard]] bool hasRoom(int descriptor, std::chrono::milliseconds most);

/// What was written is on the disk, where it goes to one.
[[nodiscard]] bool bringToDisk(const Descriptor& file);
/// And that it has this name is too, as well as it can be said.
void bringNameToDisk(const std::string& path);
[[nodiscard]] bool makeEmpty(const Descriptor& file);
/// Who could read and write a file may do the same with this one; where that may not be told it stays ours.
void takeRights(const Descriptor& file, const FileStatus& from);

/// Whether a file can be made there, as far as that can be known.
[[nodiscard]] bool mayCreateIn(const std::string& folder);
/// Gives a file another name; fails with EEXIST where that is taken and may not be.
[[nodiscard]] bool giveName(const std::string& from, const std::string& to, bool mayReplace);
void removeFile(const std::string& path);

/// Locks the file as long as it is open here. False where somebody else has it locked, or it cannot be.
[[nodiscard]] bool lockForOne(const Descriptor& file);
[[nodiscard]] Descriptor openToLock(const std::string& path);

/// Of this process.
[[nodiscard]] std::uint64_t processNumber();

} // namespace posewire::log
