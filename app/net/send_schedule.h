// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/clock.h"
#include "core/log/time.h"

#include <functional>

namespace posewire::net {

/// When to send: every deadline counts from one start, so late wake-ups never add up to drift.
class SendSchedule {
public:
    using Sleep = std::function<void(log::Duration)>;

    /// Starts now. `sleep` is for tests; by default the thread sleeps.
    explicit SendSchedule(const log::Clock& clock, Sleep sleep = {});

    /// Sleeps until that long after the start, or not at all if it has passed. Returns how late it is.
    log::Duration waitUntil(log::Duration afterStart);

    [[nodiscard]] log::Duration elapsed() const { return m_clock.monotonic() - m_start; }

private:
    const log::Clock& m_clock;
    Sleep m_sleep;
    log::Moment m_start;
};

} // namespace posewire::net
