// SPDX-License-Identifier: MIT
#include "core/model/session/playback.h"

#include <algorithm>
#include <cmath>

namespace posewire::model {

Playback::Playback(log::Stamp from, log::Moment now, double speed, const std::optional<TimeRange>& loop)
    : m_from(from),
      m_begin(now),
      m_speed(std::copysign(std::clamp(std::abs(speed), kSlowest, kFastest), speed)),
      m_loop(loop && loop->from < loop->to ? loop : std::nullopt) {
    if (m_loop && (from < m_loop->from || from >= m_loop->to)) {
        m_from = m_speed > 0 ? m_loop->from : m_loop->to - log::Duration(1);
    }
}

log::Stamp Playback::at(log::Moment now) const {
    const log::Stamp moment = m_from + log::durationOf(log::secondsOf(now - m_begin) * m_speed);
    if (!m_loop) {
        return moment;
    }
    const log::Duration length = m_loop->to - m_loop->from;
    const log::Duration into = (moment - m_loop->from) % length;
    return m_loop->from + (into < log::Duration::zero() ? into + length : into);
}

} // namespace posewire::model
