// SPDX-License-Identifier: MIT
#include "core/model/accounting/framing.h"

namespace posewire::model {

bool Framing::addUnusual(std::uint32_t sample, std::uint8_t index, bool isLast, std::uint32_t step) {
    constexpr std::int32_t kLate = 100; // farther back, the counter has restarted
    const std::int32_t ahead = distance(sample, m_newest.counter);
    if (ahead < 0 && ahead > -kLate) {
        m_alike = 0; // one that was missing, perhaps
        return false;
    }
    if (ahead != 0 && m_newest.arrived.any()) {
        close(step);
        m_before = m_newest;
        m_newest = {};
    }
    m_newest.counter = sample;
    m_newest.arrived.set(index & 127);
    m_newest.last = isLast ? index : m_newest.last;
    m_isOfSeveral = m_isOfSeveral || index != 0;
    if (isLast || m_isOfSeveral) {
        m_wasMarked = true;
        m_isUnmarked = false;
        return false;
    }
    const bool wasUnmarked = m_isUnmarked;
    m_isUnmarked = wasUnmarked || m_alike + 1 >= (m_wasMarked ? kEnough : kFirst);
    return !wasUnmarked && m_isUnmarked;
}

/// Nothing more comes of the newest sample.
void Framing::close(std::uint32_t step) {
    const bool isWhole = static_cast<int>(m_newest.arrived.count()) == m_newest.last + 1;
    const bool isNext = !m_wasMarked || step == 0 || m_newest.counter - m_before.counter == step;
    const bool isLike = isNext && m_newest.arrived == m_before.arrived && m_newest.last == m_before.last;
    m_first = isLike && m_alike != 0 ? m_first : m_newest.counter;
    m_alike = isWhole ? 0 : isLike ? m_alike + 1 : 1;
    if (isShort()) {
        m_short = {m_first, m_newest.counter};
    }
}

} // namespace posewire::model
