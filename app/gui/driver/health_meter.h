// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/monitor_health.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace posewire::gui {

/// Makes figures of what this program does out of counters that only grow.
class HealthMeter {
public:
    static constexpr std::int64_t kPeriodNs = 500'000'000;

    /// Counters at a moment of the monotonic clock.
    struct Reading {
        std::int64_t monotonicNs = 0;
        std::optional<double> receiverCpuS{};
        std::optional<double> processCpuS{};
        std::optional<double> bufferFill{};
        std::optional<std::uint64_t> memoryBytes{};
        std::uint64_t frames = 0;
    };

    /// The session took so long to follow so many packets.
    void addFollow(std::int64_t tookNs, std::uint64_t packets) {
        m_followNs += tookNs;
        m_followed += packets;
    }

    /// Whether it is time for another reading.
    [[nodiscard]] bool isDue(std::int64_t monotonicNs) const {
        return !m_before || monotonicNs - m_before->monotonicNs >= kPeriodNs;
    }
    void add(const Reading& reading);

    [[nodiscard]] const MonitorHealth& health() const { return m_health; }

private:
    std::optional<Reading> m_before;
    std::int64_t m_followNs = 0;
    std::uint64_t m_followed = 0;
    MonitorHealth m_health;
};

} // namespace posewire::gui
