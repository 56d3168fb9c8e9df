// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/send_schedule.h"

#include <thread>

namespace posewire::net {

SendSchedule::SendSchedule(const log::Clock& clock, Sleep sleep)
    : m_clock(clock), m_sleep(std::move(sleep)), m_start(clock.monotonic()) {
    if (!m_sleep) {
        m_sleep = [](log::Duration duration) { std::this_thread::sleep_for(duration); };
    }
}

log::Duration SendSchedule::waitUntil(log::Duration afterStart) {
    while (true) {
        const log::Duration late = elapsed() - afterStart;
        if (late >= log::Duration::zero()) {
            return late;
        }
        m_sleep(-late);
    }
}

} // namespace posewire::net
