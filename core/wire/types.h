// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace posewire::wire {

using Bytes = std::span<const std::byte>;

/// Detects equal bytes within one run of the program; not stable across builds.
[[nodiscard]] inline std::size_t hashOf(Bytes bytes) {
    return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Three 32-bit floats in wire order: x, y, z. The unit is in the layout of the field.
using Vec3 = std::array<float, 3>;

/// Four 32-bit floats in wire order: re, i, j, k (specification §2.5.8).
using Quat = std::array<float, 4>;

/// Nine 32-bit floats in wire order (revision E §2.6, type 10).
using Mat3 = std::array<float, 9>;

/// Bytes of the header that every datagram begins with (specification §2.4.1).
inline constexpr std::size_t kHeaderSize = 24;

/// The most a UDP datagram can carry, and so the longest datagram that is accepted.
inline constexpr std::size_t kMaxDatagramSize = 65507;

/// What "number of items" can express; segment counts are at most 67 (23 + 4 props + 40 fingers).
inline constexpr std::size_t kMaxItems = 255;
inline constexpr std::size_t kMaxSegments = 67;

} // namespace posewire::wire
