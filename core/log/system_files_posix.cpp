// SPDX-License-Identifier: MIT
#include "core/log/file_names.h"
#include "core/log/system_files.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace posewire::log {
namespace {

using Status = struct stat;

FileStatus statusFrom(const Status& status) {
    using Kind = FileStatus::Kind;
    FileStatus result;
    result.kind = S_ISREG(status.st_mode)   ? Kind::File
                  : S_ISDIR(status.st_mode) ? Kind::Folder
                  : S_ISBLK(status.st_mode) ? Kind::Disk
                                            : Kind::Stream;
    result.volume = status.st_dev;
    result.number = status.st_ino;
    result.size = static_cast<std::uint64_t>(status.st_size);
    result.names = status.st_nlink;
    return result;
}

bool isReady(int descriptor, short events, std::chrono::milliseconds most) {
    pollfd state{descriptor, events, 0};
    return ::poll(&state, 1, static_cast<int>(most.count())) > 0;
}

} // namespace

Descriptor::~Descriptor() {
    if (isOpen()) {
        ::close(m_number);
    }
}

std::optional<FileStatus> statusOf(const std::string& path) {
    Status status{};
    return ::stat(path.c_str(), &status) == 0 ? std::optional(statusFrom(status)) : std::nullopt;
}

std::optional<FileStatus> statusOf(int descriptor) {
    Status status{};
    return ::fstat(descriptor, &status) == 0 ? std::optional(statusFrom(status)) : std::nullopt;
}

Descriptor openToRead(const std::string& path) {
    return Descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
}

Descriptor openToWrite(const std::string& path) {
    return Descriptor(::open(path.c_str(), O_WRONLY | O_APPEND | O_NONBLOCK | O_CLOEXEC));
}

Descriptor createToWrite(const std::string& path, unsigned mode) {
    constexpr int flags = O_WRONLY | O_APPEND | O_CREAT | O_EXCL | O_CLOEXEC;
    Descriptor file(::open(path.c_str(), flags, S_IRUSR | S_IWUSR));
    if (file.isOpen()) {
        ::fchmod(file.number(), mode); // whatever umask and the folder say; some disks know none
    }
    return file;
}

Descriptor duplicateOf(int descriptor) {
    return Descriptor(::dup(descriptor));
}

std::ptrdiff_t readSome(const Descriptor& file, std::span<std::byte> into) {
    return ::read(file.number(), into.data(), into.size());
}

std::ptrdiff_t readSomeAt(const Descriptor& file, std::uint64_t offset, std::span<std::byte> into) {
    return ::pread(file.number(), into.data(), into.size(), static_cast<off_t>(offset));
}

std::ptrdiff_t writeSome(int descriptor, std::span<const std::byte> bytes) {
    return ::write(descriptor, bytes.data(), bytes.size());
}

bool hasNews(const Descriptor& file, std::chrono::milliseconds most) {
    return isReady(file.number(), POLLIN, most);
}

bool hasRoom(int descriptor, std::chrono::milliseconds most) {
    return isReady(descriptor, POLLOUT, most);
}

bool bringToDisk(const Descriptor& file) {
#ifdef __linux__
    const int result = ::fdatasync(file.number());
#else
    const int result = ::fsync(file.number());
#endif
    // Pipes, terminals and devices have nothing to be brought to a disk.
    return result == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP;
}

void bringNameToDisk(const std::string& path) {
    const std::string folder = nameOf(pathOf(path).parent_path());
    const Descriptor descriptor(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC));
    if (descriptor.isOpen()) {
        ::fsync(descriptor.number());
    }
}

bool makeEmpty(const Descriptor& file) {
    return ::ftruncate(file.number(), 0) == 0;
}

bool mayCreateIn(const std::string& folder) {
    return ::access(folder.c_str(), W_OK | X_OK) == 0;
}

bool giveName(const std::string& from, const std::string& to, bool mayReplace) {
    if (!mayReplace) {
        if (::link(from.c_str(), to.c_str()) == 0) {
            ::unlink(from.c_str());
            return true;
        }
        const bool isTaken = errno == EEXIST || ::access(to.c_str(), F_OK) == 0;
        if (isTaken) {
            errno = EEXIST;
            return false;
        }
    }
    std::error_code error;
    std::filesystem::rename(from, to, error); // some disks know no links
    errno = error.value();
    return !error;
}

bool lockFile(const Descriptor& file) {
    return ::flock(file.number(), LOCK_EX | LOCK_NB) == 0;
}

Descriptor openLocked(const std::string& path) {
    Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    return file.isOpen() && lockFile(file) ? std::move(file) : Descriptor();
}

std::uint64_t processNumber() {
    return static_cast<std::uint64_t>(::getpid());
}

} // namespace posewire::log
