// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <atomic>

namespace posewire::log {

/// The only way to the time. Both calls are safe from any thread.
class Clock {
public:
    virtual ~Clock() = default;

    /// Comparable with kernel receive stamps. May jump when the computer's clock is set.
    [[nodiscard]] virtual Stamp wall() const = 0;

    [[nodiscard]] virtual Moment monotonic() const = 0;
};

class SystemClock final : public Clock {
public:
    [[nodiscard]] Stamp wall() const override;
    [[nodiscard]] Moment monotonic() const override;
};

/// Stands still until it is moved.
class ManualClock final : public Clock {
public:
    explicit ManualClock(Stamp wall = {}, Moment monotonic = {}) : m_wall(wall), m_monotonic(monotonic) {}

    void advance(Duration duration) {
        m_wall = m_wall.load() + duration;
        m_monotonic = m_monotonic.load() + duration;
    }
    void setWall(Stamp wall) { m_wall = wall; }

    [[nodiscard]] Stamp wall() const override { return m_wall; }
    [[nodiscard]] Moment monotonic() const override { return m_monotonic; }

private:
    std::atomic<Stamp> m_wall;
    std::atomic<Moment> m_monotonic;
};

} // namespace posewire::log
