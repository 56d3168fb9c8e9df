// SPDX-License-Identifier: MIT
#include "core/model/loss_bursts.h"

#include <algorithm>

namespace posewire::model {

void LossBursts::add(std::uint64_t lostBefore) {
    if (lostBefore != 0) {
        m_longestGap = std::max(m_longestGap, lostBefore);
        m_lost += lostBefore;
        if (m_receivedSince >= kGmin) {
            closeCluster();
        }
        m_clusterSamples += lostBefore + (m_clusterLost != 0 ? m_receivedSince : 0);
        m_clusterLost += lostBefore;
        m_receivedSince = 0;
    }
    ++m_received;
    ++m_receivedSince;
}

void LossBursts::closeCluster() {
    // A single loss among samples that arrived is no burst.
    if (m_clusterLost > 1) {
        ++m_bursts;
        m_burstLost += m_clusterLost;
        m_burstSamples += m_clusterSamples;
    }
    m_clusterLost = 0;
    m_clusterSamples = 0;
}

LossPattern LossBursts::pattern() const {
    LossBursts closed = *this;
    closed.closeCluster();
    LossPattern pattern;
    pattern.bursts = closed.m_bursts;
    const auto burstSamples = static_cast<double>(closed.m_burstSamples);
    if (closed.m_bursts != 0) {
        pattern.burstDensity = static_cast<double>(closed.m_burstLost) / burstSamples;
        pattern.meanBurstSamples = burstSamples / static_cast<double>(closed.m_bursts);
    }
    const std::uint64_t gapSamples = closed.m_lost + closed.m_received - closed.m_burstSamples;
    if (gapSamples != 0) {
        pattern.gapDensity =
            static_cast<double>(closed.m_lost - closed.m_burstLost) / static_cast<double>(gapSamples);
    }
    return pattern;
}

} // namespace posewire::model
