// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace posewire::performer {

/// What the sender meant a datagram to be, whatever became of its bytes on the way.
struct Origin {
    std::uint32_t sample = 0; ///< counter as sent, after restarts
    std::uint8_t type = 0;
    std::uint8_t character = 0;
    std::uint32_t epoch = 0;  ///< how often the counter has restarted
    std::uint32_t regime = 0; ///< how often the rate has changed
    std::uint32_t step = 1;   ///< samples from one that is sent to the next
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

} // namespace posewire::performer
