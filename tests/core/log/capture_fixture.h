// SPDX-License-Identifier: MIT
#pragma once

#include "tests/core/log/datagram_fixture.h"

#include <algorithm>
#include <initializer_list>

/// Frames and capture files as other programs write them, byte by byte.
namespace posewire::log {

/// Appends numbers in the byte order of the file.
class CaptureBytes {
public:
    explicit CaptureBytes(bool bigEndian = true) : m_bigEndian(bigEndian) {}

    CaptureBytes& number(std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i) {
            const int shift = 8 * (m_bigEndian ? size - 1 - i : i);
            m_bytes.push_back(static_cast<std::byte>(value >> shift & 0xff));
        }
        return *this;
    }
    CaptureBytes& bytes(const ByteVector& more) {
        m_bytes.insert(m_bytes.end(), more.begin(), more.end());
        return *this;
    }
    CaptureBytes& zeros(std::size_t count) {
        m_bytes.resize(m_bytes.size() + count);
        return *this;
    }
    [[nodiscard]] const ByteVector& all() const { return m_bytes; }
    [[nodiscard]] std::size_t size() const { return m_bytes.size(); }

private:
    bool m_bigEndian;
    ByteVector m_bytes;
};

inline ByteVector slice(const ByteVector& bytes, std::size_t from, std::size_t size) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(from);
    return {begin, begin + static_cast<std::ptrdiff_t>(std::min(size, bytes.size() - from))};
}

inline ByteVector udp(const ByteVector& payload, std::uint16_t from = 40001, std::uint16_t to = 9763) {
    return CaptureBytes()
        .number(from, 2)
        .number(to, 2)
        .number(payload.size() + 8, 2)
        .number(0, 2)
        .bytes(payload)
        .all();
}

/// From 10.0.0.2 to 10.0.0.3.
inline ByteVector ipv4(const ByteVector& content, std::uint16_t fragment = 0, std::uint8_t protocol = 17) {
    return CaptureBytes()
        .number(0x4500, 2)
        .number(content.size() + 20, 2)
        .number(1, 2)
        .number(fragment, 2)
        .number(64, 1)
        .number(protocol, 1)
        .number(0, 2)
        .number(0x0a000002, 4)
        .number(0x0a000003, 4)
        .bytes(content)
        .all();
}

/// From fe80::1 to ::1, with a hop-by-hop header before UDP.
inline ByteVector ipv6(const ByteVector& content) {
    return CaptureBytes()
        .number(0x60000000, 4)
        .number(content.size() + 8, 2)
        .number(0, 1)
        .number(64, 1)
        .number(0xfe80, 2)
        .zeros(12)
        .number(1, 2)
        .zeros(14)
        .number(1, 2)
        .number(17, 1)
        .zeros(7)
        .bytes(content)
        .all();
}

inline constexpr unsigned kFin = 1;
inline constexpr unsigned kSyn = 2;
inline constexpr unsigned kReset = 4;

/// Over IPv4.
inline ByteVector tcp(std::uint32_t sequence, const ByteVector& content, unsigned flags = 0,
                      std::uint16_t from = 40001, std::uint16_t to = 9763) {
    return ipv4(CaptureBytes()
                    .number(from, 2)
                    .number(to, 2)
                    .number(sequence, 4)
                    .zeros(4)
                    .number(0x5010 | flags, 2)
                    .zeros(6)
                    .bytes(content)
                    .all(),
                0, 6);
}

inline ByteVector ethernet(const ByteVector& packet, std::uint16_t type = 0x0800) {
    return CaptureBytes().zeros(12).number(type, 2).bytes(packet).all();
}

/// A stamp in the units of the file.
struct Captured {
    std::uint32_t seconds = 0;
    std::uint32_t fraction = 0;
    ByteVector frame;
};

inline ByteVector pcap(const std::vector<Captured>& packets, std::uint32_t magic, std::uint32_t linkType,
                       bool bigEndian) {
    CaptureBytes file(bigEndian);
    file.number(magic, 4).number(2, 2).number(4, 2).zeros(8).number(65535, 4).number(linkType, 4);
    for (const Captured& packet : packets) {
        file.number(packet.seconds, 4).number(packet.fraction, 4);
        file.number(packet.frame.size(), 4).number(packet.frame.size(), 4).bytes(packet.frame);
    }
    return file.all();
}

inline ByteVector block(std::uint32_t type, const ByteVector& body, bool bigEndian) {
    const std::size_t padding = (4 - body.size() % 4) % 4;
    const std::size_t length = body.size() + padding + 12;
    return CaptureBytes(bigEndian)
        .number(type, 4)
        .number(length, 4)
        .bytes(body)
        .zeros(padding)
        .number(length, 4)
        .all();
}

inline ByteVector sectionHeader(bool bigEndian) {
    return block(0x0a0d0d0a,
                 CaptureBytes(bigEndian).number(0x1a2b3c4d, 4).number(1, 2).zeros(2).number(~0ULL, 8).all(),
                 bigEndian);
}

/// An option of a pcapng block with its padding; code 0 with nothing ends the list.
inline ByteVector option(std::uint16_t code, const ByteVector& value, bool bigEndian) {
    return CaptureBytes(bigEndian)
        .number(code, 2)
        .number(value.size(), 2)
        .bytes(value)
        .zeros((4 - value.size() % 4) % 4)
        .all();
}

/// `snapLength` 0: packets are not cut.
inline ByteVector interfaceWith(std::uint16_t linkType, std::uint32_t snapLength, const ByteVector& options,
                                bool bigEndian) {
    return block(
        1, CaptureBytes(bigEndian).number(linkType, 2).zeros(2).number(snapLength, 4).bytes(options).all(),
        bigEndian);
}

/// With a resolution of 10^-n seconds, n = `digits`.
inline ByteVector interfaceBlock(std::uint16_t linkType, std::uint8_t digits, bool bigEndian) {
    const ByteVector resolution{std::byte{digits}};
    return interfaceWith(
        linkType, 0,
        CaptureBytes().bytes(option(9, resolution, bigEndian)).bytes(option(0, {}, bigEndian)).all(),
        bigEndian);
}

inline ByteVector enhancedPacket(std::uint32_t interface, std::uint64_t stamp, const ByteVector& frame,
                                 bool bigEndian, const ByteVector& options = {}) {
    return block(6,
                 CaptureBytes(bigEndian)
                     .number(interface, 4)
                     .number(stamp >> 32, 4)
                     .number(stamp & 0xffffffffU, 4)
                     .number(frame.size(), 4)
                     .number(frame.size(), 4)
                     .bytes(frame)
                     .zeros((4 - frame.size() % 4) % 4)
                     .bytes(options)
                     .all(),
                 bigEndian);
}

/// Of a packet that was `original` bytes long on the wire.
inline ByteVector simplePacket(std::size_t original, const ByteVector& captured, bool bigEndian) {
    return block(3, CaptureBytes(bigEndian).number(original, 4).bytes(captured).all(), bigEndian);
}

} // namespace posewire::log
