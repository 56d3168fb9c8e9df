// SPDX-License-Identifier: MIT
#include "core/log/byte_io.h"

#include "core/log/system_files.h"
#include "core/wire/header.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace posewire::log {
namespace {

constexpr std::size_t kBuffer = std::size_t{64} << 10;
constexpr int kStandardInput = 0;

bool isFile(const Descriptor& descriptor) {
    const auto status = statusOf(descriptor.number());
    return status && status->kind == FileStatus::Kind::File;
}

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

void FileContents::count(std::span<const std::byte> record, bool isSkipped) {
    if (!isSkipped) {
        datagrams += wire::startsWithMagic(record) ? 1 : 0;
        bytes += record.size();
        return;
    }
    if (skipped == head.size() && bytes == 0) {
        const auto more = record.first(std::min(record.size(), kLookedAt - head.size()));
        head.insert(head.end(), more.begin(), more.end());
    }
    skipped += record.size();
}

} // namespace posewire::log
