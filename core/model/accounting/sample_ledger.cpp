// SPDX-License-Identifier: MIT
#include "core/model/accounting/sample_ledger.h"

#include <algorithm>
#include <utility>

namespace posewire::model {

Placement SampleLedger::count(const Placement& placement, log::Stamp stamp, CountHistory* history) {
    const bool isDuplicate = placement.kind == Placement::Kind::Duplicate;
    const bool isLate = placement.isReordered && placement.late > kLateAfter;
    if (isDuplicate || placement.isReordered) {
        m_settled.duplicates += isDuplicate ? 1 : 0;
        m_settled.reordered += placement.isReordered ? 1 : 0;
        m_settled.late += isLate ? 1 : 0;
        if (history != nullptr) {
            history->add(stamp, {.duplicates = isDuplicate ? 1U : 0U,
                                 .reordered = placement.isReordered ? 1U : 0U,
                                 .late = isLate ? 1U : 0U});
        }
    }
    return placement;
}

Placement SampleLedger::place(const Datagram& datagram, CountHistory* history) {
    return count(m_present.place(datagram, history), datagram.stamp, history);
}

Placement SampleLedger::placeBefore(const Datagram& datagram, CountHistory* history) {
    if (m_before.empty()) {
        return {};
    }
    const Placement placement = m_before.place(datagram, history);
    // Which counters came before a restart is forgotten: the same one after it is no duplicate.
    return placement.kind == Placement::Kind::Duplicate ? Placement{}
                                                        : count(placement, datagram.stamp, history);
}

Placement SampleLedger::placeAlone(const Datagram& datagram, CountHistory* history) {
    constexpr std::int32_t kNear = 100;
    // The first samples of a stream may come late too.
    if (m_present.overlaps(datagram.sample, datagram.sample, kNear, 0)) {
        return place(datagram, history);
    }
    return hasBefore(datagram.stamp) && m_before.overlaps(datagram.sample, datagram.sample, kNear, kNear)
               ? placeBefore(datagram, history)
               : Placement{};
}

void SampleLedger::begin(log::Stamp stamp, CountHistory* history, bool isRestart) {
    if (!m_before.empty()) {
        // A straggler may have been the first sample of all.
        m_firstSample = m_begins == 1 ? m_before.first() : m_firstSample;
        m_before.addTo(m_settled);
        m_longestGap = std::max(m_longestGap, m_before.longestGap());
        m_before.clear(history);
    }
    if (m_begins == 0) {
        m_firstSample = m_present.first();
    }
    m_present.conclude(history);
    std::swap(m_present, m_before);
    m_begin = stamp;
    ++m_begins;
    m_settled.restarts += isRestart ? 1 : 0;
    if (history != nullptr && isRestart) {
        history->add(stamp, {.restarts = 1});
    }
}

StreamCounts SampleLedger::counts() const {
    StreamCounts counts = m_settled;
    counts.longestGapSamples = m_longestGap;
    for (const SampleSequence* sequence : {&m_before, &m_present}) {
        sequence->addTo(counts);
        if (!sequence->empty()) {
            counts.longestGapSamples = std::max(counts.longestGapSamples, sequence->longestGap());
        }
    }
    if (!m_present.empty()) {
        counts.step = m_present.step();
        counts.firstSample = m_begins == 0 ? m_present.first() : m_firstSample;
        if (m_begins == 1 && !m_before.empty()) {
            counts.firstSample = m_before.first();
        }
        counts.lastSample = m_present.highest();
    }
    return counts;
}

} // namespace posewire::model
