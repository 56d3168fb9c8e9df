// SPDX-License-Identifier: MIT
#include "core/model/accounting/sender_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace posewire::model {
namespace {

/// A time code that moves by more than this between two samples jumped.
constexpr std::int32_t kMostTimeCodeMs = 60'000;

} // namespace

void SenderClock::restart() {
    m_hasFirst = false;
    m_timeCodeMs = 0;
    m_differenceMs = 0;
    ++m_generation;
}

void SenderClock::add(const Sample& sample) {
    if (!m_hasFirst) {
        m_hasFirst = true;
        m_first = m_previous = sample;
        return;
    }
    const auto moved = static_cast<std::int32_t>(sample.sample - m_previous.sample);
    const auto timeCodeMoved = static_cast<std::int32_t>(sample.timeCode - m_previous.timeCode);
    if (std::abs(timeCodeMoved) > kMostTimeCodeMs) {
        restart();
        add(sample);
        return;
    }
    const double sinceMs = log::millisecondsOf(sample.stamp - m_previous.stamp);
    if (moved != 0) {
        ++((timeCodeMoved > 0) == (moved > 0) && timeCodeMoved != 0 ? m_timed : m_untimed);
        // Forgets slowly, so that the period follows a sender that changes it.
        constexpr double kKeep = 1 - 1.0 / 1024;
        m_sumSinceMs = m_sumSinceMs * kKeep + sinceMs;
        m_sumMoved = m_sumMoved * kKeep + moved;
    }
    m_timeCodeMs += timeCodeMoved;
    const double periodMs = m_sumMoved > 0 ? m_sumSinceMs / m_sumMoved : 0;
    const double senderMs = isFromTimeCode() ? timeCodeMoved : moved * periodMs;
    m_jitterMs += (std::abs(sinceMs - senderMs) - m_jitterMs) / 16;
    m_differenceMs =
        log::millisecondsOf(sample.stamp - m_first.stamp) - static_cast<double>(m_timeCodeMs);
    m_previous = sample;
}

} // namespace posewire::model
