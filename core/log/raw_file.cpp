// SPDX-License-Identifier: MIT
#include "core/log/raw_file.h"

#include "core/log/capture_file.h"
#include "core/log/tcp_framer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace posewire::log {

namespace {

constexpr std::size_t kReadSize = std::size_t{64} << 10;

/// Gives back first what has been read to look at it, then the rest.
class Rewound final : public ByteSource {
public:
    Rewound(std::span<const std::byte> front, ByteSource& rest) : m_front(front), m_rest(rest) {}

    tl::expected<std::size_t, FileError> read(std::span<std::byte> into) override {
        if (m_front.empty()) {
            return m_rest.read(into);
        }
        const std::size_t count = std::min(into.size(), m_front.size());
        std::memcpy(into.data(), m_front.data(), count);
        m_front = m_front.subspan(count);
        return count;
    }
    [[nodiscard]] std::string name() const override { return m_rest.name(); }

private:
    std::span<const std::byte> m_front;
    ByteSource& m_rest;
};

/// Fills `into`, unless the source ends before.
tl::expected<std::size_t, FileError> readFully(ByteSource& source, std::span<std::byte> into) {
    std::size_t filled = 0;
    while (filled < into.size()) {
        const auto count = source.read(into.subspan(filled));
        if (!count) {
            return count;
        }
        if (*count == 0) {
            break;
        }
        filled += *count;
    }
    return filled;
}

} // namespace

FileFormat fileFormat(std::span<const std::byte> firstBytes) {
    if (firstBytes.size() < 4) {
        return FileFormat::Raw;
    }
    std::uint32_t magic = 0;
    for (const std::byte byte : firstBytes.first(4)) {
        magic = magic << 8 | std::to_integer<std::uint32_t>(byte);
    }
    switch (magic) {
    case 0xa1b2c3d4: // microseconds, either byte order
    case 0xd4c3b2a1:
    case 0xa1b23c4d: // nanoseconds
    case 0x4d3cb2a1:
        return FileFormat::Pcap;
    case 0x0a0d0d0a:
        return FileFormat::Pcapng;
    default:
        return FileFormat::Raw;
    }
}

Arrival arrivalOf(const FileRecord& record, SenderId sender, Stamp stamp) {
    Arrival arrival;
    arrival.stamp = record.stamp.value_or(stamp);
    arrival.sender = sender;
    arrival.kernelDropsBefore = record.kernelDropsBefore;
    arrival.flags.truncated = record.isTruncated;
    arrival.flags.stampedByKernel = record.isStampedByKernel;
    arrival.flags.skipped = record.isSkipped;
    arrival.flags.isDropRecord = record.isDropRecord;
    return arrival;
}

tl::expected<void, FileError> readRawFile(ByteSource& source, const FileVisitor& visit) {
    TcpFramer framer;
    const TcpFramer::Visitor pass = [&](const TcpFramer::Piece& piece) {
        visit(
            {piece.offset, piece.bytes, piece.kind == TcpFramer::Kind::Skipped, std::nullopt, std::nullopt});
    };
    std::vector<std::byte> buffer(kReadSize);
    while (true) {
        const auto count = source.read(buffer);
        if (!count) {
            framer.finish(pass);
            return tl::unexpected(count.error());
        }
        if (*count == 0) {
            framer.finish(pass);
            return {};
        }
        framer.push(std::span(buffer).first(*count), pass);
    }
}

tl::expected<void, FileError> readFile(ByteSource& source, const FileVisitor& visit) {
    std::array<std::byte, 4> front{};
    const auto count = readFully(source, front);
    if (!count) {
        return tl::unexpected(count.error());
    }
    const std::span<const std::byte> seen = std::span(front).first(*count);
    Rewound whole(seen, source);
    switch (fileFormat(seen)) {
    case FileFormat::Raw:
        return readRawFile(whole, visit);
    case FileFormat::Pcap:
    case FileFormat::Pcapng:
        return readCaptureFile(whole, visit);
    }
    return {};
}

} // namespace posewire::log
