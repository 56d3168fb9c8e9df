// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/noise.h"
#include "core/performer/sending.h"

#include <cstddef>
#include <span>
#include <vector>

namespace posewire::performer {

/// What a damaged datagram may turn into. What cannot be decoded is malformed and what stays itself counts as
/// itself. What turns into a part of something else is kept only where there is one answer to what it counts
/// as: the counter moves by a little, or so far that it can belong to nothing.
struct CorruptionBounds {
    double periodMs = 1000.0 / 240.0; ///< of the samples
    bool mayChangeIdentity = true;    ///< false where its samples come in parts
    bool mayChangeType = true;        ///< false where samples of other types do
};

/// Flips bits in one to four bytes. `key` chooses where and which.
void corrupt(Sending& sending, const CorruptionBounds& bounds, const KeyedRandom& random, std::uint64_t key);

/// Cuts the datagram to a random size below its own.
void truncate(Sending& sending, const KeyedRandom& random, std::uint64_t key);

/// One sample in several datagrams (§2.4.1.3): its items are divided evenly, in their order, among `parts` or
/// as many as there are items. One datagram unchanged where it cannot be divided: types that do not count
/// frames or have no list, single items, what is in parts already, what cannot be decoded.
std::vector<std::vector<std::byte>> splitSample(std::span<const std::byte> datagram, std::size_t parts);

} // namespace posewire::performer
