// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/stream_counts.h"

#include <cstdint>

namespace posewire::model {

/// Finds bursts and gaps of loss in one pass over the samples that arrived, in the order of their counters
/// (RFC 3611 §4.7.2 and appendix A.2, Gmin = 16).
class LossBursts {
public:
    static constexpr std::uint64_t kGmin = 16;

    /// A sample that arrived, with how many were lost just before it.
    void add(std::uint64_t lostBefore);
    /// Nothing is counted as lost from here to the next sample, which begins a run.
    void endRun() { closeCluster(); }

    [[nodiscard]] LossPattern pattern() const;
    [[nodiscard]] std::uint64_t longestGap() const { return m_longestGap; }

private:
    void closeCluster();

    // Losses with fewer than kGmin samples received in a row between them.
    std::uint64_t m_clusterLost = 0;
    std::uint64_t m_clusterSamples = 0;
    std::uint64_t m_receivedSince = 0; ///< since the newest loss
    std::uint64_t m_bursts = 0;
    std::uint64_t m_burstLost = 0;
    std::uint64_t m_burstSamples = 0;
    std::uint64_t m_lost = 0;
    std::uint64_t m_received = 0;
    std::uint64_t m_longestGap = 0;
};

} // namespace posewire::model
