// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/clock.h"

#include <atomic>

namespace posewire::log {

/// Shows the same time until it is moved. Safe from any thread, as a Clock has to be.
class ManualClock final : public Clock {
public:
    explicit ManualClock(WallTime wall = {}, Moment monotonic = {}) : m_wall(wall), m_monotonic(monotonic) {}

    void advance(Duration duration) {
        m_wall = m_wall.load() + duration;
        m_monotonic = m_monotonic.load() + duration;
    }

    /// As an operator does, or a time server.
    void setWall(Duration by) { m_wall = m_wall.load() + by; }

    [[nodiscard]] WallTime wall() const override { return m_wall; }
    [[nodiscard]] Moment monotonic() const override { return m_monotonic; }

private:
    std::atomic<WallTime> m_wall;
    std::atomic<Moment> m_monotonic;
};

} // namespace posewire::log
