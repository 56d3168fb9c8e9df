// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"

/// Messages in parts: one sample in several datagrams (§2.4.1.3), each with some of the items.
namespace posewire::wire {

/// What a header says as "number of items" (§2.4.1.4): of a list its items, 1 for a message without a list, 0
/// where lists have counts of their own, and for raw bytes.
[[nodiscard]] std::size_t announcedItems(const Body& body);

/// Items that can be divided among datagrams: those that the header counts.
[[nodiscard]] std::size_t dividableItems(const Body& body);

/// Leaves the dividable items from `from` to before `to`.
void keepItems(Body& body, std::size_t from, std::size_t to);

/// Appends the items of the next datagram of the same sample, and its notices. Both must be of one type;
/// types without a list of items keep what is there.
void appendPart(Datagram& whole, const Datagram& part);

} // namespace posewire::wire
