// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/performer/noise.h"
#include "core/wire/header.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace posewire::performer {

struct Origin {
    std::uint32_t sample = 0; ///< counter as sent, after restarts
    std::uint8_t type = 0;
    std::uint8_t character = 0;
    std::uint32_t epoch = 0;              ///< how often the counter has restarted
    std::uint32_t regime = 0;             ///< how often the rate has changed
    std::uint32_t step = 1;               ///< samples from one that is sent to the next
    std::optional<wire::Header> header{}; ///< as it was before its content was broken, if it was
};

/// From one sample counter to another, by the shorter way around.
inline std::int64_t distance(std::uint32_t to, std::uint32_t from) {
    return static_cast<std::int32_t>(to - from);
}

/// A jump of the counter further back or forward may be a restart (RFC 3550 A.1).
inline constexpr std::int64_t kMostBack = 100;
inline constexpr std::int64_t kMostForward = 3000;

/// A datagram on its way.
struct Sending {
    std::vector<std::byte> bytes;
    log::Duration due{}; ///< after the start
    Origin origin;
    bool isReadable = true; ///< false once it is too damaged to be decoded
};

/// What a damaged datagram may turn into. What cannot be decoded is malformed and what stays itself counts as
/// itself. What turns into a part of something else is kept only where there is one answer to what it counts
/// as: the counter moves by a little, or so far that it can belong to nothing.
struct CorruptionBounds {
    double periodMs = 1000.0 / 240.0; ///< of the samples
    bool mayChangeIdentity = true;    ///< false if its samples come in parts
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
