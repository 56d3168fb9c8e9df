// SPDX-License-Identifier: MIT
#include "core/log/clock.h"

#include <time.h>

namespace posewire::log {

WallTime SystemClock::wall() const {
    return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}

Moment SystemClock::monotonic() const {
    return std::chrono::time_point_cast<Duration>(std::chrono::steady_clock::now());
}

std::tm localTime(std::time_t time) {
    std::tm local{};
    ::localtime_r(&time, &local);
    return local;
}

} // namespace posewire::log
