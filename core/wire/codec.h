// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/faults.h"
#include "core/wire/header.h"
#include "core/wire/messages.h"

namespace posewire::wire {

/// One datagram as values: the wire's own, without conversion.
struct Datagram {
    Header header;
    Body body;
    std::vector<Notice> notices; ///< what was odd; empty for a datagram as it should be
};

/// Reads one whole datagram, with all checks. What is odd but readable becomes a notice.
[[nodiscard]] Result<Datagram> decode(Bytes bytes);

/// The same into an existing value, whose memory is reused: no allocation where the type stays the same.
/// After a failure `into` holds what was read up to the fault.
[[nodiscard]] Result<void> decodeInto(Bytes bytes, Datagram& into);

/// Writes a datagram; `into` is replaced and its memory reused. The header is written as it is. Fails with
/// CountTooLarge where a list does not fit its count, with TooLong where a text or the whole does not fit.
[[nodiscard]] Result<void> encodeInto(const Datagram& datagram, std::vector<std::byte>& into);
[[nodiscard]] Result<std::vector<std::byte>> encode(const Datagram& datagram);

enum class HeaderEra : std::uint8_t {
    Reserved, ///< revisions E to K: zero
    Counted,  ///< since MVN 2018/2019: counts and payload size
};

/// Sets type, number of items and, for HeaderEra::Counted, the payload size, from the body. The counts of
/// body segments, props and fingers are the caller's; for HeaderEra::Reserved they are cleared.
void completeHeader(Datagram& datagram, HeaderEra era);

/// Bytes of the payload that `body` is written to.
[[nodiscard]] std::size_t payloadSize(const Body& body);

// Messages in parts: one sample in several datagrams (§2.4.1.3), each with some of the items.

/// Items that can be divided among datagrams: those that the header counts.
[[nodiscard]] std::size_t dividableItems(const Body& body);

/// Leaves the dividable items from `from` to before `to`.
void keepItems(Body& body, std::size_t from, std::size_t to);

/// Appends the items of the next datagram of the same sample, and its notices. Both must be of one type;
/// types without a list of items keep what is there.
void appendPart(Datagram& whole, const Datagram& part);

} // namespace posewire::wire
