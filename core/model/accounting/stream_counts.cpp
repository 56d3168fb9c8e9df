// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_counts.h"

#include <algorithm>

namespace posewire::model {

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

} // namespace posewire::model
