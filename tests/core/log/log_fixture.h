// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet_log.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace posewire::log {

/// Four chunks, with room for what is kept beside their packets.
inline constexpr LogLimits kSmallLog{.memoryCap = std::size_t{1280} << 10,
                                     .chunkSize = std::size_t{256} << 10};

/// Bytes that depend on the seed in every place.
inline std::vector<std::byte> pattern(std::size_t size, std::uint64_t seed) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i) {
        bytes[i] = static_cast<std::byte>((seed * 131 + i * 7 + (i >> 8)) & 0xff);
    }
    return bytes;
}

inline bool equal(std::span<const std::byte> a, std::span<const std::byte> b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size()) == 0);
}

inline std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

} // namespace posewire::log
