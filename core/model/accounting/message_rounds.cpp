// SPDX-License-Identifier: MIT
#include "core/model/accounting/message_rounds.h"

#include <bit>

namespace posewire::model {

bool MessageRounds::isWhole() const {
    const int count = std::popcount(m_arrived[0]) + std::popcount(m_arrived[1]);
    return m_last >= 0 && count == m_last + 1;
}

bool MessageRounds::add(std::int64_t stampNs, std::uint8_t datagram, bool isLast) {
    const std::int64_t sinceNs = stampNs - m_newestNs;
    const bool isTogether = m_isOpen && sinceNs < kTogetherNs && sinceNs > -kTogetherNs;
    std::uint64_t& half = m_arrived[datagram >> 6 & 1];
    const std::uint64_t bit = std::uint64_t{1} << (datagram & 63);
    if (isTogether && (half & bit) != 0) {
        return true;
    }
    const bool wasIncomplete = isTogether && !isWhole();
    if (!isTogether) {
        m_arrived = {};
        m_last = -1;
        m_isOpen = true;
    }
    m_newestNs = stampNs;
    half |= bit;
    m_last = isLast ? datagram : m_last;
    m_incomplete -= wasIncomplete ? 1 : 0;
    m_incomplete += isWhole() ? 0 : 1;
    return false;
}

} // namespace posewire::model
