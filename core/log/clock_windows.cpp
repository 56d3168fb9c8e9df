// SPDX-License-Identifier: MIT
#include "core/log/clock.h"

#include <time.h>
#include <windows.h>

namespace posewire::log {

/// To 100 ns; the ordinary clock of Windows goes in steps of up to 16 ms.
WallTime SystemClock::wall() const {
    using Ticks = std::chrono::duration<std::int64_t, std::ratio<1, 10'000'000>>;
    constexpr Ticks kFrom1601To1970{116'444'736'000'000'000};
    FILETIME now{};
    ::GetSystemTimePreciseAsFileTime(&now);
    const Ticks since1601(
        static_cast<std::int64_t>((std::uint64_t{now.dwHighDateTime} << 32U) | now.dwLowDateTime));
    return WallTime(std::chrono::duration_cast<Duration>(since1601 - kFrom1601To1970));
}

/// The performance counter: it goes on while the computer sleeps.
Moment SystemClock::monotonic() const {
    static const std::int64_t frequency = [] {
        LARGE_INTEGER value{};
        ::QueryPerformanceFrequency(&value);
        return value.QuadPart;
    }();
    LARGE_INTEGER now{};
    ::QueryPerformanceCounter(&now);
    const std::int64_t rest = now.QuadPart % frequency;
    return Moment(std::chrono::seconds(now.QuadPart / frequency) +
                  Duration(rest * 1'000'000'000 / frequency));
}

std::tm localTime(std::time_t time) {
    std::tm local{};
    ::localtime_s(&local, &time);
    return local;
}

} // namespace posewire::log
