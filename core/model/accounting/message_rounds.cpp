// SPDX-License-Identifier: MIT
#include "core/model/accounting/message_rounds.h"

#include <bit>
#include <cstdlib>

namespace posewire::model {

bool MessageRounds::isWhole() const {
    const int count = std::popcount(m_arrived[0]) + std::popcount(m_arrived[1]);
    return m_last >= 0 && count == m_last + 1;
}

bool MessageRounds::add(log::Stamp stamp, std::uint8_t datagram, bool isLast) {
    const std::size_t half = datagram >> 6 & 1;
    const std::uint64_t bit = std::uint64_t{1} << (datagram & 63);
    const bool isRepeated = (m_arrived[half] & bit) != 0;
    const bool isBegin = !isOpen() || isRepeated || std::chrono::abs(stamp - m_first) > kTogether;
    if (isBegin) {
        m_arrived = {};
        m_last = -1;
        m_first = stamp;
    } else {
        m_incomplete -= isWhole() ? 0 : 1;
    }
    m_arrived[half] |= bit;
    m_last = isLast ? datagram : m_last;
    m_incomplete += isWhole() ? 0 : 1;
    return isBegin;
}

} // namespace posewire::model
