// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/program_health.h"

#include <utility>

namespace posewire::gui {

namespace {

std::optional<double> shareOf(const std::optional<double>& before, const std::optional<double>& now,
                              double seconds) {
    return before && now ? std::optional((*now - *before) / seconds) : std::nullopt;
}

} // namespace

void HealthMeter::add(const Reading& reading) {
    const std::optional<Reading> before = std::exchange(m_before, reading);
    m_health.bufferFill = reading.bufferFill;
    m_health.memoryBytes = reading.memoryBytes;
    const log::Duration follow = std::exchange(m_follow, {});
    const std::uint64_t followed = std::exchange(m_followed, 0);
    const std::uint64_t pictures = m_pictures - std::exchange(m_picturesBefore, m_pictures);
    if (followed != 0) {
        m_health.followUsPerPacket =
            static_cast<double>(follow.count()) * 1e-3 / static_cast<double>(followed);
    }
    const double seconds = before ? log::secondsOf(reading.monotonic - before->monotonic) : 0;
    if (seconds <= 0) {
        return;
    }
    m_health.receiverShare = shareOf(before->receiverCpuS, reading.receiverCpuS, seconds);
    m_health.processShare = shareOf(before->processCpuS, reading.processCpuS, seconds);
    m_health.followShare = log::secondsOf(follow) / seconds;
    m_health.framesPerSecond = static_cast<double>(pictures) / seconds;
}

} // namespace posewire::gui
