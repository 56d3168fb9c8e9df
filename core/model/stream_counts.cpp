// SPDX-License-Identifier: MIT
#include "core/model/stream_counts.h"

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

} // namespace posewire::model
