// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "core/log/time.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace posewire::gui {

/// Makes figures of what this program does out of counters that only grow.
class HealthMeter {
public:
    static constexpr log::Duration kPeriod = std::chrono::milliseconds(500);

    /// Counters at a moment of the monotonic clock.
    struct Reading {
        log::Moment monotonic{};
        std::optional<double> receiverCpuS{};
        std::optional<double> processCpuS{};
        std::optional<double> bufferFill{};
        std::optional<std::uint64_t> memoryBytes{};
    };

    /// Time that the session took to follow a number of packets.
    void addFollow(log::Duration took, std::uint64_t packets) {
        m_follow += took;
        m_followed += packets;
    }

    /// Pictures shown since the start, and how they are drawn now.
    void setPictures(std::uint64_t shown, PictureHealth health) {
        m_pictures = shown;
        m_health.picture = std::move(health);
    }
    /// What the bodies in the viewport take, and can become.
    void setMeshMemory(std::size_t bytes, std::size_t most) {
        m_health.meshBytes = bytes;
        m_health.mostMeshBytes = most;
    }

    /// It is time for another reading.
    [[nodiscard]] bool isDue(log::Moment monotonic) const {
        return !m_before || monotonic - m_before->monotonic >= kPeriod;
    }
    void add(const Reading& reading);

    [[nodiscard]] const MonitorHealth& health() const { return m_health; }

private:
    std::optional<Reading> m_before;
    log::Duration m_follow{};
    std::uint64_t m_followed = 0;
    std::uint64_t m_pictures = 0;
    std::uint64_t m_picturesBefore = 0;
    MonitorHealth m_health;
};

} // namespace posewire::gui
