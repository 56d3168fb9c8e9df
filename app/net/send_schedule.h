// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/clock.h"

#include <cstdint>
#include <functional>

namespace posewire::net {

/// When to send: every moment is counted from one start, so that late sleeps never add up to drift.
class SendSchedule {
public:
    using Sleep = std::function<void(std::int64_t nanoseconds)>;

    /// The start is now. `sleep` is for tests; without it the thread sleeps.
    explicit SendSchedule(const log::Clock& clock, Sleep sleep = {});

    /// Sleeps until so long after the start; not at all where that is past. Tells how late it is.
    std::int64_t waitUntil(std::int64_t nanosecondsAfterStart);

    [[nodiscard]] std::int64_t elapsedNs() const { return m_clock.monotonicNs() - m_startNs; }

private:
    const log::Clock& m_clock;
    Sleep m_sleep;
    std::int64_t m_startNs;
};

} // namespace posewire::net
