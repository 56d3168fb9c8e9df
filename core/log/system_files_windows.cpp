// SPDX-License-Identifier: MIT
#include "core/log/file_names.h"
#include "core/log/system_files.h"

#include <algorithm>
#include <cerrno>
#include <limits>
#include <thread>

#include <windows.h>

#include <fcntl.h>
#include <io.h>

namespace posewire::log {
namespace {

constexpr DWORD kShared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

int errnoOf(DWORD error) {
    switch (error) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_DRIVE:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_PATHNAME:
    case ERROR_BAD_NETPATH:
    case ERROR_BAD_NET_NAME:
    case ERROR_DIRECTORY:
        return ENOENT;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_WRITE_PROTECT:
        return EACCES;
    case ERROR_LOCK_VIOLATION:
        return EWOULDBLOCK;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
        return EEXIST;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
        return ENOSPC;
    case ERROR_FILE_TOO_LARGE:
        return EFBIG;
    case ERROR_BROKEN_PIPE:
    case ERROR_NO_DATA:
    case ERROR_PIPE_NOT_CONNECTED:
        return EPIPE;
    case ERROR_FILENAME_EXCED_RANGE:
        return ENAMETOOLONG;
    case ERROR_INVALID_HANDLE:
        return EBADF;
    case ERROR_NOT_READY:
        return ENXIO;
    default:
        return EIO;
    }
}

/// False, with the reason of the last call in errno.
bool failed() {
    errno = errnoOf(::GetLastError());
    return false;
}

bool isDone(BOOL result) {
    return result != FALSE || failed();
}

HANDLE handleOf(int descriptor) {
    const std::intptr_t handle = descriptor < 0 ? -1 : ::_get_osfhandle(descriptor);
    return handle == -2 ? INVALID_HANDLE_VALUE : reinterpret_cast<HANDLE>(handle); // -2: a closed stream
}

/// A handle, closed with its owner.
class Handle {
public:
    explicit Handle(HANDLE handle) : m_handle(handle) {}
    ~Handle() {
        if (isOpen()) {
            ::CloseHandle(m_handle);
        }
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    [[nodiscard]] HANDLE get() const { return m_handle; }
    [[nodiscard]] bool isOpen() const { return m_handle != INVALID_HANDLE_VALUE; }

private:
    HANDLE m_handle;
};

bool isFolder(const std::string& path) {
    const DWORD attributes = ::GetFileAttributesW(pathOf(path).c_str());
    return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

Descriptor opened(const std::string& path, DWORD access, DWORD disposition) {
    const HANDLE handle = ::CreateFileW(pathOf(path).c_str(), access, kShared, nullptr, disposition,
                                        FILE_ATTRIBUTE_NORMAL, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        failed();
        errno = errno == EACCES && isFolder(path) ? EISDIR : errno;
        return Descriptor();
    }
    const int number = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY | _O_NOINHERIT);
    if (number < 0) {
        ::CloseHandle(handle);
    }
    return Descriptor(number);
}

FileStatus statusFrom(HANDLE handle) {
    FileStatus status;
    BY_HANDLE_FILE_INFORMATION facts{};
    if (::GetFileType(handle) != FILE_TYPE_DISK || ::GetFileInformationByHandle(handle, &facts) == FALSE) {
        return status;
    }
    status.kind = (facts.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0 ? FileStatus::Kind::Folder
                                                                           : FileStatus::Kind::File;
    status.volume = facts.dwVolumeSerialNumber;
    status.number = (std::uint64_t{facts.nFileIndexHigh} << 32) | facts.nFileIndexLow;
    status.size = (std::uint64_t{facts.nFileSizeHigh} << 32) | facts.nFileSizeLow;
    status.names = facts.nNumberOfLinks;
    return status;
}

DWORD sizeOf(std::size_t bytes) {
    return static_cast<DWORD>(std::min<std::size_t>(bytes, std::numeric_limits<std::int32_t>::max()));
}

/// What was read, where reading ended with that result.
std::ptrdiff_t readResult(BOOL result, DWORD count) {
    const DWORD error = result != FALSE ? ERROR_SUCCESS : ::GetLastError();
    const bool isEnd = error == ERROR_HANDLE_EOF || error == ERROR_BROKEN_PIPE;
    if (error == ERROR_SUCCESS || isEnd) {
        return isEnd ? 0 : static_cast<std::ptrdiff_t>(count);
    }
    errno = errnoOf(error);
    return -1;
}

} // namespace

Descriptor::~Descriptor() {
    if (isOpen()) {
        ::_close(m_number);
    }
}

std::optional<FileStatus> statusOf(const std::string& path) {
    // Folders are opened only with the flag.
    const Handle handle(::CreateFileW(pathOf(path).c_str(), FILE_READ_ATTRIBUTES, kShared, nullptr,
                                      OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
    if (!handle.isOpen()) {
        failed();
        return std::nullopt;
    }
    return statusFrom(handle.get());
}

std::optional<FileStatus> statusOf(int descriptor) {
    const HANDLE handle = handleOf(descriptor);
    if (handle == INVALID_HANDLE_VALUE) {
        errno = EBADF;
        return std::nullopt;
    }
    return statusFrom(handle);
}

Descriptor openToRead(const std::string& path) {
    return opened(path, GENERIC_READ, OPEN_EXISTING);
}

Descriptor openToWrite(const std::string& path) {
    return opened(path, GENERIC_WRITE, OPEN_EXISTING);
}

Descriptor createToWrite(const std::string& path, unsigned) {
    return opened(path, GENERIC_WRITE, CREATE_NEW);
}

Descriptor duplicateOf(int descriptor) {
    return Descriptor(::_dup(descriptor));
}

std::ptrdiff_t readSome(const Descriptor& file, std::span<std::byte> into) {
    DWORD count = 0;
    const BOOL result =
        ::ReadFile(handleOf(file.number()), into.data(), sizeOf(into.size()), &count, nullptr);
    return readResult(result, count);
}

std::ptrdiff_t readSomeAt(const Descriptor& file, std::uint64_t offset, std::span<std::byte> into) {
    OVERLAPPED place{};
    place.Offset = static_cast<DWORD>(offset & 0xffffffffU);
    place.OffsetHigh = static_cast<DWORD>(offset >> 32U);
    DWORD count = 0;
    const BOOL result = ::ReadFile(handleOf(file.number()), into.data(), sizeOf(into.size()), &count, &place);
    return readResult(result, count);
}

std::ptrdiff_t writeSome(int descriptor, std::span<const std::byte> bytes) {
    DWORD count = 0;
    const BOOL result =
        ::WriteFile(handleOf(descriptor), bytes.data(), sizeOf(bytes.size()), &count, nullptr);
    return isDone(result) ? static_cast<std::ptrdiff_t>(count) : -1;
}

/// A pipe is asked again and again: it is nothing that can be waited for.
bool hasNews(const Descriptor& file, std::chrono::milliseconds most) {
    constexpr std::chrono::milliseconds step{5};
    const HANDLE handle = handleOf(file.number());
    if (::GetFileType(handle) == FILE_TYPE_CHAR) {
        return ::WaitForSingleObject(handle, static_cast<DWORD>(most.count())) != WAIT_TIMEOUT;
    }
    for (auto waited = step;; waited += step) {
        DWORD there = 0;
        const bool isPipe = ::GetFileType(handle) == FILE_TYPE_PIPE;
        if (!isPipe || ::PeekNamedPipe(handle, nullptr, 0, nullptr, &there, nullptr) == FALSE || there != 0) {
            return true;
        }
        if (waited > most) {
            return false;
        }
        std::this_thread::sleep_for(step);
    }
}

/// Windows does not tell whether a pipe has room: writing waits for its reader.
bool hasRoom(int, std::chrono::milliseconds) {
    return true;
}

bool bringToDisk(const Descriptor& file) {
    const HANDLE handle = handleOf(file.number());
    return ::GetFileType(handle) != FILE_TYPE_DISK || isDone(::FlushFileBuffers(handle));
}

void bringNameToDisk(const std::string&) {} // giveName() has written it through

bool makeEmpty(const Descriptor& file) {
    const HANDLE handle = handleOf(file.number());
    return isDone(::SetFilePointerEx(handle, LARGE_INTEGER{}, nullptr, FILE_BEGIN)) &&
           isDone(::SetEndOfFile(handle));
}

bool mayCreateIn(const std::string& folder) {
    if (isFolder(folder)) {
        return true;
    }
    errno = ENOENT;
    return false;
}

bool giveName(const std::string& from, const std::string& to, bool mayReplace) {
    const DWORD flags = MOVEFILE_WRITE_THROUGH | (mayReplace ? MOVEFILE_REPLACE_EXISTING : 0U);
    return isDone(::MoveFileExW(pathOf(from).c_str(), pathOf(to).c_str(), flags));
}

/// Locks a byte behind all that a file can hold: others cannot read or write locked bytes.
bool lockFile(const Descriptor& file) {
    OVERLAPPED place{};
    place.OffsetHigh = 0x7fffffff;
    constexpr DWORD flags = LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY;
    return isDone(::LockFileEx(handleOf(file.number()), flags, 0, 1, 0, &place));
}

Descriptor openLocked(const std::string& path) {
    Descriptor file = opened(path, GENERIC_READ | GENERIC_WRITE, OPEN_EXISTING);
    return file.isOpen() && lockFile(file) ? std::move(file) : Descriptor();
}

std::uint64_t processNumber() {
    return ::GetCurrentProcessId();
}

} // namespace posewire::log
