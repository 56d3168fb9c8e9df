// SPDX-License-Identifier: MIT
#include "core/log/byte_io.h"

#include "core/log/descriptor_sink.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <istream>

namespace posewire::log {
namespace {

constexpr std::size_t kBuffer = std::size_t{64} << 10;
constexpr int kStandardInput = 0;

bool isFile(const Descriptor& descriptor) {
    const auto status = statusOf(descriptor.number());
    return status && status->kind == FileStatus::Kind::File;
}

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
          m_isCancelled(std::move(isCancelled)),
          m_mayBlock(!isFile(m_descriptor)) {}

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
            if (m_mayBlock && !hasNews(m_descriptor, kPause)) {
                continue;
            }
            const std::ptrdiff_t count = readSome(m_descriptor, m_buffer);
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
    /// Between two looks at whether it is cancelled.
    static constexpr std::chrono::milliseconds kPause{100};

    Descriptor m_descriptor;
    std::string m_name;
    IsCancelled m_isCancelled;
    bool m_mayBlock;
    std::vector<std::byte> m_buffer = std::vector<std::byte>(kBuffer);
    std::span<const std::byte> m_rest;
};

class DescriptorStore final : public ByteStore {
public:
    explicit DescriptorStore(Descriptor descriptor) : m_descriptor(std::move(descriptor)) {}

    [[nodiscard]] std::size_t readAt(std::uint64_t offset, std::span<std::byte> into) const override {
        std::size_t filled = 0;
        while (filled < into.size()) {
            const std::ptrdiff_t count = readSomeAt(m_descriptor, offset + filled, into.subspan(filled));
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
    Descriptor descriptor = openToRead(path);
    if (!descriptor.isOpen()) {
        return unreadable(path, errno);
    }
    if (const auto status = statusOf(descriptor.number());
        status && status->kind == FileStatus::Kind::Folder) {
        return unreadable(path, EISDIR);
    }
    return std::make_unique<DescriptorSource>(std::move(descriptor), path, std::move(isCancelled));
}

tl::expected<std::shared_ptr<const ByteStore>, FileError> openStore(const std::string& path) {
    Descriptor descriptor = openToRead(path);
    if (!descriptor.isOpen()) {
        return unreadable(path, errno);
    }
    if (!isFile(descriptor)) {
        const auto status = statusOf(descriptor.number());
        return unreadable(path, status && status->kind == FileStatus::Kind::Folder ? EISDIR : ESPIPE);
    }
    return std::make_shared<DescriptorStore>(std::move(descriptor));
}

std::unique_ptr<ByteSource> openStandardInput(IsCancelled isCancelled) {
    return std::make_unique<DescriptorSource>(duplicateOf(kStandardInput), "standard input",
                                              std::move(isCancelled));
}

std::unique_ptr<ByteSource> readingFrom(std::istream& stream, std::string name) {
    return std::make_unique<StreamSource>(stream, std::move(name));
}

DescriptorSink::DescriptorSink(Descriptor descriptor, std::string name, std::string consequence)
    : m_descriptor(std::move(descriptor)),
      m_name(std::move(name)),
      m_consequence(std::move(consequence)),
      m_isFile(isFile(m_descriptor)) {
    m_waiting.reserve(kBuffer);
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
    return bringToDisk(m_descriptor) ? tl::expected<void, FileError>() : failure();
}

tl::expected<void, FileError> DescriptorSink::put(std::span<const std::byte> bytes) {
    constexpr std::size_t piece = 4096; // a pipe that has room takes as much at once
    while (!bytes.empty() && !m_hasFailed) {
        if (!m_isFile && !waitForRoom()) {
            errno = ETIME;
            return failure();
        }
        const std::size_t most = m_isFile ? bytes.size() : std::min(bytes.size(), piece);
        const std::ptrdiff_t count = writeSome(m_descriptor.number(), bytes.first(most));
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
    constexpr std::chrono::milliseconds step{50};
    constexpr std::chrono::milliseconds patience{1000};
    std::chrono::milliseconds waited{};
    while (!hasRoom(m_descriptor.number(), step)) {
        waited = m_isHurried ? waited + step : std::chrono::milliseconds();
        if (waited >= patience) {
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
#ifdef EDQUOT
    case EDQUOT:
#endif
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
