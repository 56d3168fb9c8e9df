// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/faults.h"
#include "core/performer/performer.h"
#include "core/performer/truth.h"

#include <vector>

namespace posewire::performer {

/// All datagrams of one sender in the order of their leaving.
inline std::vector<Sending> performWithFaults(const PerformerSettings& performance, FaultSettings settings,
                                              double seconds, FaultTally* tally = nullptr) {
    settings.rateHz = performance.rateHz;
    Performer performer(performance);
    Faults faults(settings);
    std::vector<wire::Datagram> frame;
    std::vector<std::byte> bytes;
    std::vector<Sending> sendings;
    const auto frames = static_cast<std::uint64_t>(seconds * performance.rateHz);
    for (std::uint64_t index = 0; index < frames; ++index) {
        performer.frameInto(index, frame);
        const log::Duration due(
            static_cast<std::int64_t>(static_cast<double>(index) * 1e9 / performance.rateHz));
        for (const wire::Datagram& datagram : frame) {
            if (wire::encodeInto(datagram, bytes)) {
                faults.offer(bytes, due);
            }
        }
        faults.take(due, sendings);
    }
    faults.take(std::nullopt, sendings);
    if (tally != nullptr) {
        *tally = faults.tally();
    }
    return sendings;
}

inline Truth truthOf(const std::vector<Sending>& sendings) {
    Truth truth;
    for (const Sending& sending : sendings) {
        truth.add(sending);
    }
    return truth;
}

} // namespace posewire::performer
