// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>

namespace posewire::log {

/// How long.
using Duration = std::chrono::nanoseconds;

/// A moment of the wall clock, since 1970-01-01 UTC, as in recordings and kernel stamps.
using Stamp = std::chrono::sys_time<Duration>;

/// A moment of a clock that never goes back. For intervals and schedules.
using Moment = std::chrono::time_point<std::chrono::steady_clock, Duration>;

[[nodiscard]] constexpr double secondsOf(Duration duration) {
    return static_cast<double>(duration.count()) * 1e-9;
}
[[nodiscard]] constexpr double millisecondsOf(Duration duration) {
    return static_cast<double>(duration.count()) * 1e-6;
}

/// Whole nanoseconds, towards zero.
[[nodiscard]] constexpr Duration durationOf(double seconds) {
    return Duration(static_cast<std::int64_t>(seconds * 1e9));
}

/// Nanoseconds since 1970-01-01 UTC: how files and JSON write a stamp.
[[nodiscard]] constexpr std::int64_t nanosecondsOf(Stamp stamp) {
    return stamp.time_since_epoch().count();
}
[[nodiscard]] constexpr Stamp stampOf(std::int64_t nanoseconds) {
    return Stamp(Duration(nanoseconds));
}

} // namespace posewire::log
