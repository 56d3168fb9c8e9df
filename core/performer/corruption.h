// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/noise.h"
#include "core/performer/sending.h"

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

} // namespace posewire::performer
