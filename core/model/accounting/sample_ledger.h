// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/sample_sequence.h"

#include <cstdint>

namespace posewire::model {

/// Counts datagrams whose place among the samples of a stream is decided: what belongs to the sequence since
/// the newest restart, and stragglers of the one before it.
class SampleLedger {
public:
    /// For this long after a beginning, a straggler of the sequence before it still counts there.
    static constexpr log::Duration kStraggling = std::chrono::seconds(10);
    /// Reordered by more than this is late.
    static constexpr log::Duration kLateAfter = std::chrono::milliseconds(50);

    using Datagram = SampleSequence::Datagram;

    /// In the present sequence.
    Placement place(const Datagram& datagram, CountHistory* history);
    /// In the sequence before the restart, where one of its samples was still missing.
    Placement placeBefore(const Datagram& datagram, CountHistory* history);
    /// One that came alone from far away: near a sequence it counts there, else nowhere.
    Placement placeAlone(const Datagram& datagram, CountHistory* history);
    /// The next datagram placed is the first of a sequence. `isRestart`: because the counter restarted.
    void begin(log::Stamp stamp, CountHistory* history, bool isRestart);

    /// See SampleSequence.
    void completeAll(CountHistory* history, const std::function<void(std::uint32_t)>& f) {
        m_present.completeAll(history, f);
    }
    void conclude(CountHistory* history) { m_present.conclude(history); }
    void addBursts(CountHistory* history) { m_present.addBursts(history); }

    [[nodiscard]] const SampleSequence& present() const { return m_present; }
    [[nodiscard]] const SampleSequence& before() const { return m_before; }
    /// True if something of the sequence before may still come.
    [[nodiscard]] bool hasBefore(log::Stamp stamp) const {
        return !m_before.empty() && stamp - m_begin < kStraggling;
    }

    /// See SampleSequence.
    void setMost(std::size_t samples, CountHistory* history) {
        m_present.setMost(samples, history);
        m_before.setMost(samples, history);
    }
    [[nodiscard]] std::size_t memoryBytes() const {
        return m_present.window().memoryBytes() + m_before.window().memoryBytes();
    }

    /// All but datagrams and bytes.
    [[nodiscard]] StreamCounts counts() const;
    /// Adds the bursts that the history does not know yet, those that ended in a range of time.
    void addNewestBursts(const TimeRange& range, BurstCounts& into) const {
        m_before.addNewestBursts(range, into);
        m_present.addNewestBursts(range, into);
    }

private:
    Placement count(const Placement& placement, log::Stamp stamp, CountHistory* history);

    log::Stamp m_begin{};
    std::uint64_t m_begins = 0; ///< after the first
    SampleSequence m_present;
    SampleSequence m_before;
    StreamCounts m_settled; ///< of the sequences before those, and what belongs to none
    std::uint32_t m_firstSample = 0;
    std::uint64_t m_longestGap = 0; ///< likewise
};

} // namespace posewire::model
