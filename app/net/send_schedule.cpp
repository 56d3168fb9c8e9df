// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/send_schedule.h"

#include <chrono>
#include <thread>

namespace posewire::net {

SendSchedule::SendSchedule(const log::Clock& clock, Sleep sleep)
    : m_clock(clock), m_sleep(std::move(sleep)), m_startNs(clock.monotonicNs()) {
    if (!m_sleep) {
        m_sleep = [](std::int64_t nanoseconds) {
            std::this_thread::sleep_for(std::chrono::nanoseconds(nanoseconds));
        };
    }
}

std::int64_t SendSchedule::waitUntil(std::int64_t nanosecondsAfterStart) {
    while (true) {
        const std::int64_t lateNs = elapsedNs() - nanosecondsAfterStart;
        if (lateNs >= 0) {
            return lateNs;
        }
        m_sleep(-lateNs);
    }
}

} // namespace posewire::net
