// SPDX-License-Identifier: MIT
#include "core/log/clock.h"

#include <chrono>

namespace posewire::log {

namespace {

template <typename ChronoClock>
std::int64_t nanoseconds() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(ChronoClock::now().time_since_epoch())
        .count();
}

} // namespace

std::int64_t SystemClock::wallNs() const {
    return nanoseconds<std::chrono::system_clock>();
}

std::int64_t SystemClock::monotonicNs() const {
    return nanoseconds<std::chrono::steady_clock>();
}

} // namespace posewire::log
