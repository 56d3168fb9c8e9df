// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/process_figures.h"

#include <windows.h>

#include <psapi.h>
#ifdef __MINGW32__
#include <pthread.h>
#endif

namespace posewire::system {
namespace {

/// In units of 100 ns.
std::uint64_t ticksOf(const FILETIME& time) {
    return (std::uint64_t{time.dwHighDateTime} << 32U) | time.dwLowDateTime;
}

double secondsOf(std::uint64_t ticks) {
    return static_cast<double>(ticks) * 1e-7;
}

HANDLE handleOf(std::thread& thread) {
#ifdef __MINGW32__
    return static_cast<HANDLE>(::pthread_gethandle(thread.native_handle()));
#else
    return thread.native_handle();
#endif
}

struct Times {
    FILETIME begin{};
    FILETIME end{};
    FILETIME kernel{};
    FILETIME user{};
};

} // namespace

/// The library's clock() counts the time that goes by.
std::optional<double> processCpuSeconds() {
    Times times;
    if (::GetProcessTimes(::GetCurrentProcess(), &times.begin, &times.end, &times.kernel, &times.user) ==
        FALSE) {
        return std::nullopt;
    }
    return secondsOf(ticksOf(times.kernel) + ticksOf(times.user));
}

std::optional<double> threadCpuSeconds(std::thread& thread) {
    Times times;
    if (::GetThreadTimes(handleOf(thread), &times.begin, &times.end, &times.kernel, &times.user) == FALSE) {
        return std::nullopt;
    }
    return secondsOf(ticksOf(times.kernel) + ticksOf(times.user));
}

std::optional<std::uint64_t> processMemoryBytes() {
    PROCESS_MEMORY_COUNTERS counters{};
    counters.cb = sizeof counters;
    if (::GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters) == FALSE) {
        return std::nullopt;
    }
    return counters.WorkingSetSize;
}

double processAgeMs() {
    Times times;
    FILETIME now{};
    ::GetSystemTimePreciseAsFileTime(&now);
    ::GetProcessTimes(::GetCurrentProcess(), &times.begin, &times.end, &times.kernel, &times.user);
    return secondsOf(ticksOf(now) - ticksOf(times.begin)) * 1e3;
}

void yieldToOthers() {
    ::SetThreadPriority(::GetCurrentThread(), THREAD_PRIORITY_BELOW_NORMAL);
}

} // namespace posewire::system
