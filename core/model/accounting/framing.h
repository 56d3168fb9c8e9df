// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/sample_sequence.h"

#include <bitset>
#include <cstdint>
#include <optional>
#include <utility>

namespace posewire::model {

/// Watches that the samples of a stream are framed as the header says: datagrams 0 to n, the last one marked.
/// Senders exist that never mark it, and senders that never send one of several.
class Framing {
public:
    /// A datagram of a sample of a sequence. Returns true if this one shows that a datagram is a whole
    /// sample, although it is not marked as the last.
    bool add(std::uint32_t sample, std::uint8_t index, bool isLast, const SampleSequence& sequence) {
        if (isLast && index == 0 && m_newest.last == 0) { // as always
            m_newest.counter = sample;
            m_alike = 0;
            return false;
        }
        return addUnusual(sample, index, isLast, sequence.step());
    }

    /// Samples have one datagram each, which is not marked as the last.
    [[nodiscard]] bool isUnmarked() const { return m_isUnmarked; }
    /// The newest samples all lack the same datagram of several.
    [[nodiscard]] bool isShort() const { return m_alike >= kShort && m_isOfSeveral; }
    /// So does this one.
    [[nodiscard]] bool isShort(std::uint32_t sample) const {
        return m_short && distance(sample, m_short->first) >= 0 && distance(m_short->second, sample) >= 0;
    }

private:
    // Samples in a row that are no chance: for a mark that was there before, for one that never was, and for
    // a datagram that a bad network loses often.
    static constexpr std::uint32_t kEnough = 8;
    static constexpr std::uint32_t kFirst = 4;
    static constexpr std::uint32_t kShort = 12;

    struct Sample {
        std::uint32_t counter = 0;
        int last = -1;            ///< index of the datagram that is marked; -1: none is yet
        std::bitset<128> arrived; ///< by index
    };
    bool addUnusual(std::uint32_t sample, std::uint8_t index, bool isLast, std::uint32_t step);
    void close(std::uint32_t step);

    Sample m_newest;
    Sample m_before;
    std::uint32_t m_alike = 0;  ///< samples in a row that lack the same; those before the newest
    std::uint32_t m_first = 0;  ///< of these
    bool m_isOfSeveral = false; ///< a sample had a second datagram
    bool m_wasMarked = false;
    bool m_isUnmarked = false;
    std::optional<std::pair<std::uint32_t, std::uint32_t>> m_short{}; ///< the first and the last such sample
};

} // namespace posewire::model
