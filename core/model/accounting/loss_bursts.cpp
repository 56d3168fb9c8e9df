// SPDX-License-Identifier: MIT
#include "core/model/accounting/loss_bursts.h"

namespace posewire::model {

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
