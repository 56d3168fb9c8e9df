// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/thread_time.h"

#if __has_include(<pthread.h>) && __has_include(<unistd.h>)
#include <ctime>

#include <pthread.h>
#include <unistd.h>
#endif

namespace posewire::net {

std::optional<double> cpuSeconds([[maybe_unused]] std::thread& thread) {
#if defined(_POSIX_THREAD_CPUTIME) && _POSIX_THREAD_CPUTIME >= 0
    clockid_t clock{};
    timespec time{};
    if (thread.joinable() && ::pthread_getcpuclockid(thread.native_handle(), &clock) == 0 &&
        ::clock_gettime(clock, &time) == 0) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
    }
#endif
    return std::nullopt;
}

} // namespace posewire::net
