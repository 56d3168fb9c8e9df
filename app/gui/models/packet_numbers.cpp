// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_numbers.h"

#include <algorithm>
#include <bit>
#include <iterator>

namespace posewire::gui {

void PacketNumbers::append(std::uint64_t number) {
    if (m_blocks.empty()) {
        m_first = number / kNumbers * kNumbers;
    }
    const std::uint64_t place = number - m_first;
    while (place / kNumbers >= m_blocks.size()) {
        m_blocks.push_back({m_end, {}});
    }
    m_blocks.back().bits[place % kNumbers / 64] |= std::uint64_t{1} << place % 64;
    ++m_end;
}

void PacketNumbers::dropBefore(std::uint64_t number) {
    m_dropped += placeOf(number);
    while (!m_blocks.empty() && m_first + kNumbers <= number) {
        m_blocks.pop_front();
        m_first += kNumbers;
    }
}

std::uint64_t PacketNumbers::operator[](std::size_t place) const {
    const std::uint64_t wanted = m_dropped + place;
    const auto block = std::prev(std::ranges::upper_bound(m_blocks, wanted, {}, &Block::before));
    std::uint64_t left = wanted - block->before;
    std::size_t word = 0;
    for (auto count = std::popcount(block->bits[0]); left >= static_cast<std::uint64_t>(count);
         count = std::popcount(block->bits[word])) {
        left -= static_cast<std::uint64_t>(count);
        ++word;
    }
    std::uint64_t bits = block->bits[word];
    for (; left > 0; --left) {
        bits &= bits - 1;
    }
    const auto before = static_cast<std::uint64_t>(block - m_blocks.begin()) * kNumbers + word * 64;
    return m_first + before + static_cast<std::uint64_t>(std::countr_zero(bits));
}

std::size_t PacketNumbers::placeOf(std::uint64_t number) const {
    const std::uint64_t place = number > m_first ? number - m_first : 0;
    if (place / kNumbers >= m_blocks.size()) {
        return m_blocks.empty() ? 0 : size();
    }
    const Block& block = m_blocks[place / kNumbers];
    const std::size_t word = place % kNumbers / 64;
    std::uint64_t count = block.before;
    for (std::size_t i = 0; i < word; ++i) {
        count += static_cast<std::uint64_t>(std::popcount(block.bits[i]));
    }
    count +=
        static_cast<std::uint64_t>(std::popcount(block.bits[word] & ((std::uint64_t{1} << place % 64) - 1)));
    return count > m_dropped ? count - m_dropped : 0;
}

} // namespace posewire::gui
