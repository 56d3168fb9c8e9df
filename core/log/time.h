// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace posewire::log {

using Duration = std::chrono::nanoseconds;

/// A moment of the wall clock, since 1970-01-01 UTC, as in recordings and kernel stamps. It jumps where
/// somebody sets that clock.
using WallTime = std::chrono::sys_time<Duration>;

/// A moment of a log: begins as the wall clock and runs steadily from there, whatever that clock is set to.
/// For rates, gaps, jitter and ages; Timeline knows the wall time of each.
struct LogTime {};
using Stamp = std::chrono::time_point<LogTime, Duration>;

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

/// Nanoseconds since 1970-01-01 UTC: how files and JSON write a time.
[[nodiscard]] constexpr std::int64_t nanosecondsOf(WallTime time) {
    return time.time_since_epoch().count();
}

/// "-1.500000000": seconds with all decimals.
[[nodiscard]] inline std::string secondsText(Duration time) {
    const bool isNegative = time < Duration::zero();
    const auto count = static_cast<std::uint64_t>(time.count());
    const std::uint64_t size = isNegative ? 0 - count : count;
    const std::string decimals = std::to_string(size % 1'000'000'000);
    return (isNegative ? "-" : "") + std::to_string(size / 1'000'000'000) + '.' +
           std::string(9 - decimals.size(), '0') + decimals;
}

[[nodiscard]] constexpr Stamp stampOf(std::int64_t nanoseconds) {
    return Stamp(Duration(nanoseconds));
}

/// The two are the same where the clock was never set.
[[nodiscard]] constexpr Stamp asStamp(WallTime time) {
    return Stamp(time.time_since_epoch());
}
[[nodiscard]] constexpr WallTime asWallTime(Stamp stamp) {
    return WallTime(stamp.time_since_epoch());
}

} // namespace posewire::log
