// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

namespace posewire::log {

/// The only way to the time. Both calls are safe from any thread.
class Clock {
public:
    virtual ~Clock() = default;

    /// Nanoseconds since 1970-01-01 UTC: comparable with kernel receive stamps. May jump when the computer's
    /// clock is set.
    [[nodiscard]] virtual std::int64_t wallNs() const = 0;

    /// Nanoseconds since some fixed moment; never goes back. For intervals and schedules.
    [[nodiscard]] virtual std::int64_t monotonicNs() const = 0;
};

class SystemClock final : public Clock {
public:
    [[nodiscard]] std::int64_t wallNs() const override;
    [[nodiscard]] std::int64_t monotonicNs() const override;
};

/// Stands still until it is moved.
class ManualClock final : public Clock {
public:
    explicit ManualClock(std::int64_t wallNs = 0, std::int64_t monotonicNs = 0)
        : m_wallNs(wallNs), m_monotonicNs(monotonicNs) {}

    void advance(std::int64_t nanoseconds) {
        m_wallNs += nanoseconds;
        m_monotonicNs += nanoseconds;
    }
    void setWallNs(std::int64_t wallNs) { m_wallNs = wallNs; }

    [[nodiscard]] std::int64_t wallNs() const override { return m_wallNs; }
    [[nodiscard]] std::int64_t monotonicNs() const override { return m_monotonicNs; }

private:
    std::atomic<std::int64_t> m_wallNs;
    std::atomic<std::int64_t> m_monotonicNs;
};

} // namespace posewire::log
