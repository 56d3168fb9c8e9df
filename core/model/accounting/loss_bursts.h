// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/stream_counts.h"

#include <cstdint>
#include <optional>

namespace posewire::model {

/// Finds bursts and gaps of loss in one pass over the samples that arrived, in the order of their counters
/// (RFC 3611 §4.7.2 and appendix A.2, Gmin = 16).
class LossBursts {
public:
    static constexpr std::uint64_t kGmin = 16;

    /// From its first loss to its last.
    struct Burst {
        std::uint64_t lost = 0;
        std::uint64_t samples = 0;
        log::Stamp end{}; ///< when the first sample after it arrived
    };

    /// A sample that arrived, with how many were lost just before it. Returns the burst that is over with it.
    std::optional<Burst> add(std::uint64_t lostBefore, log::Stamp stamp);
    /// Nothing is counted as lost from here to the next sample, which begins a run.
    std::optional<Burst> endRun();

private:
    Burst m_cluster; ///< losses with fewer than kGmin samples received in a row between them
    std::uint64_t m_receivedSince = 0; ///< since the newest loss
};

} // namespace posewire::model
