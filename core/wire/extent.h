// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/header.h"

namespace posewire::wire {

/// How long the datagram at the front of a byte stream is. MXTP over TCP has no framing of its own.
struct Extent {
    enum class State : std::uint8_t {
        Known,    ///< `size` bytes, some of which may still be to come
        NeedMore, ///< these bytes do not tell yet
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

} // namespace posewire::wire
