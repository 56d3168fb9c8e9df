// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/faults.h"
#include "core/wire/types.h"

namespace posewire::wire {

/// The header of every datagram (§2.4.1). Bytes 17–23 are "reserved" in revisions E to K and zero there;
/// later senders fill them with the counts and the payload size.
struct Header {
    std::array<char, 6> id{'M', 'X', 'T', 'P', '0', '0'};
    std::uint32_t sampleCounter = 0;
    std::uint8_t datagramCounter = 0x80;
    std::uint8_t items = 0;
    std::uint32_t timeCode = 0;
    std::uint8_t character = 0;
    std::uint8_t bodySegments = 0;
    std::uint8_t props = 0;
    std::uint8_t fingerSegments = 0;
    std::uint16_t reserved = 0;
    std::uint16_t payloadSize = 0;

    /// The two digits as a decimal number: "02" is 2, "13" is 13.
    [[nodiscard]] std::uint8_t type() const {
        return static_cast<std::uint8_t>((id[4] - '0') * 10 + (id[5] - '0'));
    }
    void setType(std::uint8_t type) {
        id[4] = static_cast<char>('0' + type / 10 % 10);
        id[5] = static_cast<char>('0' + type % 10);
    }

    /// Place of this datagram among those of its sample, from 0 (§2.4.1.3).
    [[nodiscard]] std::uint8_t datagramIndex() const { return datagramCounter & 0x7f; }
    [[nodiscard]] bool isLast() const { return (datagramCounter & kLast) != 0; }
    void markLast() { datagramCounter |= kLast; }
    static constexpr std::uint8_t kLast = 0x80;

    /// Items that the counts of newer senders add up to; 0 for older senders.
    [[nodiscard]] unsigned countedSegments() const { return bodySegments + props + fingerSegments; }

    friend bool operator==(const Header&, const Header&) = default;
};

/// True if the bytes begin with "MXTP": what does not is foreign.
[[nodiscard]] bool startsWithMagic(Bytes bytes);

/// True if the bytes begin with "MXTP" and two digits: the start of a datagram of any type.
[[nodiscard]] bool startsDatagram(Bytes bytes);

/// Reads the header. Fails with HeaderTruncated, BadMagic or BadType.
[[nodiscard]] Result<Header> decodeHeader(Bytes bytes);

/// How long the datagram at the front of a byte stream is. MXTP over TCP has no framing of its own.
struct Extent {
    enum class State : std::uint8_t {
        Known,    ///< `size` bytes, some of which may still be to come
        NeedMore, ///< these bytes do not decide it yet
        Unknown,  ///< a header, but its length cannot be computed: look for the next datagram
        Foreign,  ///< not the start of a datagram
    };
    State state = State::Foreign;
    std::size_t size = 0;

    friend bool operator==(const Extent&, const Extent&) = default;
};

/// Takes the payload size of the header; where older senders leave it 0, computes the size from the type's
/// layout. Where a type comes in several sizes, the one that is followed by another datagram or (with
/// `isAtEnd`) by the end wins. Needs at most kMaxDatagramSize + 6 bytes to decide.
[[nodiscard]] Extent datagramExtent(Bytes bytes, bool isAtEnd);

/// Bytes of the first datagram of a packet: all, unless its sizes close it and another one begins there.
[[nodiscard]] std::size_t firstDatagram(Bytes packet);
[[nodiscard]] std::size_t countDatagrams(Bytes packet);

} // namespace posewire::wire
