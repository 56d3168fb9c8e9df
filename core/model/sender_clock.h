// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/stream_counts.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace posewire::model {

/// Compares the sender's clock with ours. The sender's is the header time code where it advances with the
/// samples, else the sample counter times its own period. Bounded memory, O(1) for each sample.
class SenderClock {
public:
    struct Sample {
        std::int64_t stampNs = 0;
        std::uint32_t sample = 0;
        std::uint32_t timeCode = 0; ///< ms
    };
    /// The first datagram of a sample, in the order of arrival.
    void add(const Sample& sample);
    /// The counter began anew: what comes has nothing to do with what came, except for the jitter.
    void restart();

    [[nodiscard]] ClockFigures figures() const;
    [[nodiscard]] double jitterMs() const { return m_jitterMs; }

private:
    static constexpr std::size_t kMostSlots = 128;
    static constexpr std::int64_t kFirstSlotNs = 250'000'000;
    /// The least delayed sample of a while: the network only ever adds to what the clocks differ by.
    struct Slot {
        std::int64_t sinceNs = 0; ///< by our clock, since the first sample
        double differenceMs = 0;  ///< our clock minus the sender's, both since the first sample
    };
    void addSlot(std::int64_t sinceNs, double differenceMs);
    void halve();

    bool m_hasFirst = false;
    Sample m_first;
    Sample m_previous;
    double m_jitterMs = 0;
    std::uint64_t m_timed = 0;   ///< successive samples whose time code advanced with them
    std::uint64_t m_untimed = 0; ///< successive samples whose time code did not
    double m_sumSinceMs = 0;     ///< between the successive samples of the period
    double m_sumMoved = 0;
    std::int64_t m_timeCodeMs = 0; ///< since the first sample, without wrap-around
    std::array<Slot, kMostSlots> m_slots{};
    std::size_t m_slotCount = 0;
    std::int64_t m_slotNs = kFirstSlotNs;
};

} // namespace posewire::model
