// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/stream_counts.h"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace posewire::model {

/// Modulo 2^32.
[[nodiscard]] constexpr std::int32_t distance(std::uint32_t to, std::uint32_t from) {
    return static_cast<std::int32_t>(to - from);
}

/// The newest samples of a stream that arrived, in the order of their counters, with what arrived of each.
/// Counters are compared modulo 2^32. Memory grows with the samples up to most() of them.
class SampleWindow {
public:
    static constexpr std::uint16_t kWhole = 0xffff;    ///< parts: one datagram, which has come
    static constexpr std::uint16_t kUnmarked = 0xfffe; ///< parts: nothing has come yet

    struct Entry {
        log::Stamp stamp{}; ///< of its first datagram
        std::uint32_t sample = 0;
        std::uint16_t parts = kUnmarked; ///< place of its mask, or one of the above
        std::uint8_t last = 0xff;        ///< index of its last datagram, 0xff before that is known
        bool isAdvance : 1 = false;      ///< it was the highest when it came
        bool isComplete : 1 = false;     ///< all its datagrams came
    };

    [[nodiscard]] std::size_t size() const { return m_size; }
    [[nodiscard]] bool empty() const { return m_size == 0; }
    [[nodiscard]] const Entry& operator[](std::size_t index) const {
        return m_entries[(m_front + index) & (m_entries.size() - 1)];
    }
    [[nodiscard]] const Entry& back() const { return (*this)[m_size - 1]; }
    /// True once samples below the first have been forgotten.
    [[nodiscard]] bool hasForgotten() const { return m_hasForgotten; }

    struct Slot {
        std::size_t index = 0;
        bool isThere = false;
    };
    [[nodiscard]] Slot find(std::uint32_t sample) const;

    /// Inserts a sample of which nothing has arrived. Forgets the lowest one where the window is full;
    /// nothing may be inserted below that one then. Returns its index.
    std::size_t insert(std::size_t index, std::uint32_t sample, log::Stamp stamp);

    enum class Mark : std::uint8_t { Duplicate, Part, Completing };
    /// Notes a datagram of the sample at an index.
    Mark mark(std::size_t index, std::uint8_t datagram, bool isLast);
    /// The sample at an index, of which the first datagram came, has no other.
    void complete(std::size_t index);
    /// True if a datagram of the sample at an index has arrived.
    [[nodiscard]] bool contains(std::size_t index, std::uint8_t datagram) const;

    void clear();

    /// A power of two.
    [[nodiscard]] std::size_t most() const { return m_most; }
    /// Forgets the lowest ones where there are more; returns how many.
    std::size_t setMost(std::size_t most);
    [[nodiscard]] std::size_t memoryBytes() const;
    [[nodiscard]] static constexpr std::size_t mostBytes(std::size_t most) {
        return most * (sizeof(Entry) + sizeof(Mask) + sizeof(std::uint16_t));
    }

private:
    using Mask = std::bitset<128>; ///< by datagram index

    [[nodiscard]] Entry& at(std::size_t index) {
        return m_entries[(m_front + index) & (m_entries.size() - 1)];
    }
    std::uint16_t takeMask();
    void forgetFront();
    void unwind();
    void compact();

    std::vector<Entry> m_entries; ///< a ring; its size is a power of two
    std::size_t m_most = AccountingDepth().samples;
    std::size_t m_front = 0;
    std::size_t m_size = 0;
    bool m_hasForgotten = false;
    std::vector<Mask> m_masks;
    std::vector<std::uint16_t> m_spareMasks;
};

} // namespace posewire::model
