// SPDX-License-Identifier: MIT
#include "core/log/byte_io.h"

#include "core/log/descriptor.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <istream>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace posewire::log {
namespace {

constexpr std::size_t kBuffer = std::size_t{64} << 10;

class StreamSource final : public ByteSource {
public:
    StreamSource(std::istream& stream, std::string name) : m_stream(stream), m_name(std::move(name)) {}

    tl::expected<std::size_t, FileError> read(std::span<std::byte> into) override {
        m_stream.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(into.size()));
        if (m_stream.bad()) {
            return tl::unexpected(
                FileError{m_name + ": reading failed; the device or the connection behind it may be gone"});
        }
        return static_cast<std::size_t>(m_stream.gcount());
    }
    [[nodiscard]] std::string name() const override { return m_name; }

private:
    std::istream& m_stream;
    std::string m_name;
};

class DescriptorSource final : public ByteSource {
public:
    DescriptorSource(Descriptor descriptor, std::string name, IsCancelled isCancelled)
        : m_descriptor(std::move(descriptor)),
          m_name(std::move(name)),
          m_isCancelled(std::move(isCancelled)) {
        struct stat status {};
        m_mayBlock = ::fstat(m_descriptor.number(), &status) != 0 || !S_ISREG(status.st_mode);
    }

    tl::expected<std::size_t, FileError> read(std::span<std::byte> into) override {
        if (m_rest.empty() && !into.empty()) {
            if (auto fetched = fetch(); !fetched) {
                return tl::unexpected(fetched.error());
            }
        }
        const std::size_t count = std::min(into.size(), m_rest.size());
        std::copy_n(m_rest.begin(), count, into.begin());
        m_rest = m_rest.subspan(count);
        return count;
    }
    [[nodiscard]] std::string name() const override { return m_name; }

private:
    tl::expected<void, FileError> fetch() {
        while (true) {
            if (m_isCancelled && m_isCancelled()) {
                return tl::unexpected(
                    FileError{m_name + ": reading was interrupted", FileError::Kind::Cancelled});
            }
            if (m_mayBlock && !hasNews()) {
                continue;
            }
            const ssize_t count = ::read(m_descriptor.number(), m_buffer.data(), m_buffer.size());
            if (count >= 0) {
                m_rest = std::span(m_buffer).first(static_cast<std::size_t>(count));
                return {};
            }
            if (errno != EINTR && errno != EAGAIN) {
                return tl::unexpected(FileError{
                    m_name + ": reading failed; the device or the connection behind it may be gone"});
            }
        }
    }
    /// Waits a little for bytes, or the end.
    [[nodiscard]] bool hasNews() const {
        constexpr int waitMs = 100;
        pollfd state{m_descriptor.number(), POLLIN, 0};
        return ::poll(&state, 1, waitMs) > 0;
    }

    Descriptor m_descriptor;
    std::string m_name;
    IsCancelled m_isCancelled;
    bool m_mayBlock = false;
    std::vector<std::byte> m_buffer = std::vector<std::byte>(kBuffer);
    std::span<const std::byte> m_rest;
};

class DescriptorStore final : public ByteStore {
public:
    explicit DescriptorStore(Descriptor descriptor) : m_descriptor(std::move(descriptor)) {}

    [[nodiscard]] std::size_t readAt(std::uint64_t offset, std::span<std::byte> into) const override {
        std::size_t filled = 0;
        while (filled < into.size()) {
            const ssize_t count = ::pread(m_descriptor.number(), into.data() + filled, into.size() - filled,
                                          static_cast<off_t>(offset + filled));
            if (count > 0) {
                filled += static_cast<std::size_t>(count);
            } else if (count == 0 || errno != EINTR) {
                break;
            }
        }
        return filled;
    }

private:
    Descriptor m_descriptor;
};

tl::unexpected<FileError> unreadable(const std::string& path, int error) {
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return tl::unexpected(FileError{path + ": no such file; check the name and the folder"});
    case EISDIR:
        return tl::unexpected(FileError{path + ": is a folder; name a file in it"});
    case EACCES:
        return tl::unexpected(FileError{path + ": no permission to read it; ask its owner"});
    case ESPIPE:
        return tl::unexpected(FileError{path + ": is a pipe or a device; name a file"});
    case ENXIO:
        return tl::unexpected(FileError{path + ": is a socket or a device that is not there; name a file"});
    default:
        return tl::unexpected(FileError{path + ": " + std::strerror(error)});
    }
}

} // namespace

tl::expected<std::unique_ptr<ByteSource>, FileError> openFile(const std::string& path,
                                                              IsCancelled isCancelled) {
    // Opening a pipe that nobody writes to must not wait: reading does, and can be cancelled.
    Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (!descriptor.isOpen()) {
        return unreadable(path, errno);
    }
    struct stat status {};
    if (::fstat(descriptor.number(), &status) == 0 && S_ISDIR(status.st_mode)) {
        return unreadable(path, EISDIR);
    }
    return std::make_unique<DescriptorSource>(std::move(descriptor), path, std::move(isCancelled));
}

tl::expected<std::shared_ptr<const ByteStore>, FileError> openStore(const std::string& path) {
    Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (!descriptor.isOpen()) {
        return unreadable(path, errno);
    }
    struct stat status {};
    if (::fstat(descriptor.number(), &status) != 0 || !S_ISREG(status.st_mode)) {
        return unreadable(path, S_ISDIR(status.st_mode) ? EISDIR : ESPIPE);
    }
    return std::make_shared<DescriptorStore>(std::move(descriptor));
}

std::unique_ptr<ByteSource> openStandardInput(IsCancelled isCancelled) {
    return std::make_unique<DescriptorSource>(Descriptor(::dup(STDIN_FILENO)), "standard input",
                                              std::move(isCancelled));
}

std::unique_ptr<ByteSource> readingFrom(std::istream& stream, std::string name) {
    return std::make_unique<StreamSource>(stream, std::move(name));
}

Descriptor::~Descriptor() {
    if (isOpen()) {
        ::close(m_number);
    }
}

DescriptorSink::DescriptorSink(Descriptor descriptor, std::string name, std::string consequence)
    : m_descriptor(std::move(descriptor)), m_name(std::move(name)), m_consequence(std::move(consequence)) {
    m_waiting.reserve(kBuffer);
    struct stat status {};
    m_isFile = ::fstat(m_descriptor.number(), &status) == 0 && S_ISREG(status.st_mode);
}

DescriptorSink::~DescriptorSink() {
    static_cast<void>(DescriptorSink::flush());
}

tl::expected<void, FileError> DescriptorSink::write(std::span<const std::byte> bytes) {
    if (m_waiting.size() + bytes.size() > kBuffer) {
        if (auto flushed = flush(); !flushed) {
            return flushed;
        }
    }
    if (bytes.size() >= kBuffer) {
        return put(bytes);
    }
    m_waiting.insert(m_waiting.end(), bytes.begin(), bytes.end());
    return {};
}

tl::expected<void, FileError> DescriptorSink::flush() {
    auto result = put(m_waiting);
    m_waiting.clear();
    return result;
}

tl::expected<void, FileError> DescriptorSink::sync() {
    if (auto flushed = flush(); !flushed) {
        return flushed;
    }
#ifdef __linux__
    const int result = ::fdatasync(m_descriptor.number());
#else
    const int result = ::fsync(m_descriptor.number());
#endif
    // Pipes, terminals and devices have nothing to be brought to a disk.
    const bool isNoDisk = result != 0 && (errno == EINVAL || errno == EROFS || errno == ENOTSUP);
    return result == 0 || isNoDisk ? tl::expected<void, FileError>() : failure();
}

tl::expected<void, FileError> DescriptorSink::put(std::span<const std::byte> bytes) {
    constexpr std::size_t piece = 4096; // a pipe that has room takes as much at once
    while (!bytes.empty() && !m_hasFailed) {
        if (!m_isFile && !waitForRoom()) {
            errno = ETIME;
            return failure();
        }
        const std::size_t most = m_isFile ? bytes.size() : std::min(bytes.size(), piece);
        const ssize_t count = ::write(m_descriptor.number(), bytes.data(), most);
        if (count >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        } else if (errno != EINTR && errno != EAGAIN) {
            return failure();
        }
    }
    return {};
}

/// False where there is none for a second although somebody waits for the end.
bool DescriptorSink::waitForRoom() const {
    constexpr int stepMs = 50;
    constexpr int patienceMs = 1000;
    int waitedMs = 0;
    pollfd state{m_descriptor.number(), POLLOUT, 0};
    while (::poll(&state, 1, stepMs) == 0) { // an error counts as room: writing says what it is
        waitedMs = m_isHurried ? waitedMs + stepMs : 0;
        if (waitedMs >= patienceMs) {
            return false;
        }
    }
    return true;
}

tl::unexpected<FileError> DescriptorSink::failure() {
    const int error = errno;
    m_hasFailed = true;
    std::string why;
    switch (error) {
    case ENOSPC:
    case EDQUOT:
        why = "the disk is full; make room or choose another disk";
        break;
    case EFBIG:
        why =
            "writing failed (the file has the largest size that is allowed); raise the limit, see ulimit -f";
        break;
    case ETIME:
        why = "nobody reads it";
        break;
    case EPIPE:
        why = "nobody reads it any more";
        break;
    default:
        why = std::string("writing failed (") + std::strerror(error) + "); is the disk still there?";
    }
    const bool isUnread = error == EPIPE;
    return tl::unexpected(FileError{m_name + ": " + why + "; " + m_consequence,
                                    isUnread ? FileError::Kind::Unread : FileError::Kind::Failed});
}

void DescriptorSink::discard() {
    m_waiting.clear();
    m_hasFailed = true;
}

} // namespace posewire::log
