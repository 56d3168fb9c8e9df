// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace posewire::log {

/// A stream is what one sender sends of one character in one message type. In order of these.
struct StreamKey {
    SenderId sender{};
    std::uint8_t character = 0;
    std::uint8_t type = 0; ///< the two digits as a decimal number

    friend auto operator<=>(const StreamKey&, const StreamKey&) = default;
};

} // namespace posewire::log

/// Senders are numbered densely from 0: multiplying spreads the bits over all buckets.
template <>
struct std::hash<posewire::log::StreamKey> {
    std::size_t operator()(const posewire::log::StreamKey& key) const noexcept {
        const auto sender = static_cast<std::uint64_t>(key.sender);
        return static_cast<std::size_t>(
            (sender << 16 | std::uint64_t{key.character} << 8 | key.type) * 0x9e3779b97f4a7c15U >> 13);
    }
};
