// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_counts.h"

#include <algorithm>

namespace posewire::model {

std::string_view nameOf(LossCause cause) {
    constexpr std::array<std::string_view, kLossCauses> names{"this computer", "network", "sender", "unknown",
                                                              "transport"};
    return names[static_cast<std::size_t>(cause)];
}

StreamCounts& StreamCounts::operator+=(const StreamCounts& other) {
    datagrams += other.datagrams;
    bytes += other.bytes;
    samples += other.samples;
    lost += other.lost;
    duplicates += other.duplicates;
    reordered += other.reordered;
    late += other.late;
    incomplete += other.incomplete;
    restarts += other.restarts;
    longestGapSamples = std::max(longestGapSamples, other.longestGapSamples);
    step = firstSample = lastSample = 0;
    return *this;
}

LossPattern patternOf(const BurstCounts& bursts, const StreamCounts& counts) {
    LossPattern pattern;
    pattern.bursts = bursts.bursts;
    const auto burstSamples = static_cast<double>(bursts.samples);
    if (bursts.bursts != 0) {
        pattern.burstDensity = static_cast<double>(bursts.lost) / burstSamples;
        pattern.meanBurstSamples = burstSamples / static_cast<double>(bursts.bursts);
    }
    // At the ends of a range a burst may reach beyond it.
    const double gapSamples = static_cast<double>(counts.expected()) - burstSamples;
    if (gapSamples > 0) {
        const double gapLost = static_cast<double>(counts.lost) - static_cast<double>(bursts.lost);
        pattern.gapDensity = std::max(0.0, gapLost) / gapSamples;
    }
    return pattern;
}

std::optional<LossBursts::Burst> LossBursts::add(std::uint64_t lostBefore, log::Stamp stamp) {
    std::optional<Burst> over;
    if (lostBefore != 0) {
        if (m_receivedSince >= kGmin) {
            over = endRun();
        }
        m_cluster.samples += lostBefore + (m_cluster.lost != 0 ? m_receivedSince : 0);
        m_cluster.lost += lostBefore;
        m_cluster.end = stamp;
        m_receivedSince = 0;
    }
    ++m_receivedSince;
    return over;
}

std::optional<LossBursts::Burst> LossBursts::endRun() {
    const Burst over = m_cluster;
    m_cluster = {};
    // A single loss among samples that arrived is no burst.
    return over.lost > 1 ? std::optional(over) : std::nullopt;
}

} // namespace posewire::model
