// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace posewire::gui {

/// Numbers of packets, by size: about a bit for each packet between the first and the last, however many of
/// them are in. A place is found in logarithmic time.
class PacketNumbers {
public:
    /// Numbers grow.
    void append(std::uint64_t number);
    void append(const std::vector<std::uint64_t>& numbers) {
        for (const std::uint64_t number : numbers) {
            append(number);
        }
    }
    void dropBefore(std::uint64_t number);
    void clear() { *this = {}; }

    [[nodiscard]] std::size_t size() const { return m_end - m_dropped; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    /// The number at a place, which is below size().
    [[nodiscard]] std::uint64_t operator[](std::size_t place) const;
    /// How many are below a number.
    [[nodiscard]] std::size_t placeOf(std::uint64_t number) const;

private:
    static constexpr std::size_t kWords = 64;
    static constexpr std::size_t kNumbers = kWords * 64; ///< of a block
    struct Block {
        std::uint64_t before = 0; ///< how many are in the blocks before it, those that were dropped included
        std::array<std::uint64_t, kWords> bits{};
    };

    std::deque<Block> m_blocks;
    std::uint64_t m_first = 0;   ///< the number of the first bit
    std::uint64_t m_end = 0;     ///< how many there ever were
    std::uint64_t m_dropped = 0; ///< of them
};

} // namespace posewire::gui
