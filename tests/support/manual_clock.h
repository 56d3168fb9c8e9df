// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/clock.h"

#include <atomic>

namespace posewire::log {

/// Shows the same time until it is moved. Safe from any thread, as a Clock has to be.
class ManualClock final : public Clock {
public:
    explicit ManualClock(Stamp wall = {}, Moment monotonic = {}) : m_wall(wall), m_monotonic(monotonic) {}

    void advance(Duration duration) {
        m_wall = m_wall.load() + duration;
        m_monotonic = m_monotonic.load() + duration;
    }

    [[nodiscard]] Stamp wall() const override { return m_wall; }
    [[nodiscard]] Moment monotonic() const override { return m_monotonic; }

private:
    std::atomic<Stamp> m_wall;
    std::atomic<Moment> m_monotonic;
};

} // namespace posewire::log
