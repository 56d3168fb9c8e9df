// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/clock.h"

#include <cstdint>
#include <functional>

namespace posewire::net {

/// When to send: every deadline counts from one start, so late wake-ups never add up to drift.
class SendSchedule {
public:
    using Sleep = std::function<void(std::int64_t nanoseconds)>;

    /// Starts now. `sleep` is for tests; by default the thread sleeps.
    explicit SendSchedule(const log::Clock& clock, Sleep sleep = {});

    /// Sleeps until that long after the start, or not at all if it has passed. Returns how late it is.
    std::int64_t waitUntil(std::int64_t nanosecondsAfterStart);

    [[nodiscard]] std::int64_t elapsedNs() const { return m_clock.monotonicNs() - m_startNs; }

private:
    const log::Clock& m_clock;
    Sleep m_sleep;
    std::int64_t m_startNs;
};

} // namespace posewire::net
