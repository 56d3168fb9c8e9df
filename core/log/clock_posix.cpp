// SPDX-License-Identifier: MIT
#include "core/log/clock.h"

#include <time.h>

namespace posewire::log {

WallTime SystemClock::wall() const {
    return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}

Moment SystemClock::monotonic() const {
#ifdef CLOCK_BOOTTIME
    // The steady clock of the library stops while the computer sleeps, and the wall clock does not: waking up
    // would look like a clock that was set.
    timespec now{};
    if (::clock_gettime(CLOCK_BOOTTIME, &now) == 0) {
        return Moment(std::chrono::seconds(now.tv_sec) + Duration(now.tv_nsec));
    }
#endif
    return std::chrono::time_point_cast<Duration>(std::chrono::steady_clock::now());
}

std::tm localTime(std::time_t time) {
    std::tm local{};
    ::localtime_r(&time, &local);
    return local;
}

} // namespace posewire::log
