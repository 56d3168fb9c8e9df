// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>

namespace posewire::log {

/// How long.
using Duration = std::chrono::nanoseconds;

/// A moment of the wall clock: nanoseconds since 1970-01-01 UTC, as in recordings and kernel stamps.
using Stamp = std::chrono::sys_time<Duration>;

/// For what still counts nanoseconds as a bare number (its name ends in Ns).
inline constexpr std::int64_t kSecondNs = 1'000'000'000;
inline constexpr std::int64_t kMillisecondNs = 1'000'000;

[[nodiscard]] constexpr double secondsOf(Duration duration) {
    return std::chrono::duration<double>(duration).count();
}
[[nodiscard]] constexpr double secondsOf(std::int64_t nanoseconds) {
    return static_cast<double>(nanoseconds) * 1e-9;
}

} // namespace posewire::log
