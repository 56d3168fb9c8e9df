// SPDX-License-Identifier: MIT
#include "core/model/sender_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace posewire::model {
namespace {

constexpr double kMsPerNs = 1e-6;
/// A time code that moves by more than this between two samples jumped.
constexpr std::int32_t kMostTimeCodeMs = 60'000;
/// Fewer slots than these tell no skew.
constexpr std::size_t kLeastSlots = 8;

} // namespace

void SenderClock::restart() {
    m_hasFirst = false;
    m_slotCount = 0;
    m_slotNs = kFirstSlotNs;
    m_timeCodeMs = 0;
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
    const double sinceMs = static_cast<double>(sample.stampNs - m_previous.stampNs) * kMsPerNs;
    if (moved != 0) {
        ++((timeCodeMoved > 0) == (moved > 0) && timeCodeMoved != 0 ? m_timed : m_untimed);
        // Forgets slowly, so that the period follows a sender that changes it.
        constexpr double kKeep = 1 - 1.0 / 1024;
        m_sumSinceMs = m_sumSinceMs * kKeep + sinceMs;
        m_sumMoved = m_sumMoved * kKeep + moved;
    }
    m_timeCodeMs += timeCodeMoved;
    const bool isTimed = m_timed > m_untimed;
    const double periodMs = m_sumMoved > 0 ? m_sumSinceMs / m_sumMoved : 0;
    const double senderMs = isTimed ? timeCodeMoved : moved * periodMs;
    m_jitterMs += (std::abs(sinceMs - senderMs) - m_jitterMs) / 16;
    const std::int64_t sinceFirstNs = sample.stampNs - m_first.stampNs;
    addSlot(sinceFirstNs, static_cast<double>(sinceFirstNs) * kMsPerNs - static_cast<double>(m_timeCodeMs));
    m_previous = sample;
}

void SenderClock::addSlot(std::int64_t sinceNs, double differenceMs) {
    if (m_slotCount != 0 && sinceNs / m_slotNs <= m_slots[m_slotCount - 1].sinceNs / m_slotNs) {
        Slot& slot = m_slots[m_slotCount - 1];
        if (differenceMs < slot.differenceMs) {
            slot = {sinceNs, differenceMs};
        }
        return;
    }
    if (m_slotCount == kMostSlots) {
        halve();
    }
    m_slots[m_slotCount++] = {sinceNs, differenceMs};
}

void SenderClock::halve() {
    m_slotNs *= 2;
    for (std::size_t i = 0; i < kMostSlots / 2; ++i) {
        const Slot& a = m_slots[2 * i];
        const Slot& b = m_slots[2 * i + 1];
        m_slots[i] = a.differenceMs <= b.differenceMs ? a : b;
    }
    m_slotCount = kMostSlots / 2;
}

ClockFigures SenderClock::figures() const {
    ClockFigures figures;
    figures.jitterMs = m_jitterMs;
    figures.isFromTimeCode = m_timed > m_untimed;
    if (!figures.isFromTimeCode || m_slotCount < kLeastSlots) {
        return figures;
    }
    // Least squares over the least delayed samples.
    const auto count = static_cast<double>(m_slotCount);
    double meanS = 0;
    double meanMs = 0;
    for (std::size_t i = 0; i < m_slotCount; ++i) {
        meanS += static_cast<double>(m_slots[i].sinceNs) * 1e-9 / count;
        meanMs += m_slots[i].differenceMs / count;
    }
    double product = 0;
    double square = 0;
    for (std::size_t i = 0; i < m_slotCount; ++i) {
        const double seconds = static_cast<double>(m_slots[i].sinceNs) * 1e-9 - meanS;
        product += seconds * (m_slots[i].differenceMs - meanMs);
        square += seconds * seconds;
    }
    if (square > 0) {
        // Ours minus theirs grows where theirs is slow; 1 ms in a second is 1,000 ppm.
        const double slope = -product / square;
        figures.skewPpm = slope * 1e3;
        figures.driftMs = slope * static_cast<double>(m_slots[m_slotCount - 1].sinceNs) * 1e-9;
    }
    return figures;
}

} // namespace posewire::model
