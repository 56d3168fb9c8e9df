// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/stream_counts.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace posewire::model {

/// A datagram as it arrives, with what only its sender knows: which run it is of.
struct SentDatagram {
    log::Stamp stamp{};
    std::uint32_t sample = 0;
    std::uint8_t index = 0;
    bool isLast = true;
    int run = 0;
};

/// A stretch of samples of one step.
struct SentRun {
    std::uint32_t step = 1;
    bool isRestart = false; ///< else only the step changed
};

/// The plain and slow way to count: it keeps everything and knows the runs.
inline StreamCounts referenceCounts(const std::vector<SentDatagram>& arrivals,
                                    const std::vector<SentRun>& runs) {
    struct Sample {
        std::set<int> parts;
        int last = -1;
    };
    struct Run {
        std::map<std::int64_t, Sample> samples; ///< by counter without wrap-around
        std::uint32_t origin = 0;
    };
    StreamCounts counts;
    std::vector<Run> found(runs.size());
    int sequence = 0;
    std::vector<int> sequenceOfRun;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        sequence += runs[i].isRestart ? 1 : 0;
        sequenceOfRun.push_back(sequence);
    }
    struct Seen {
        std::int64_t position;
        log::Stamp stamp;
    };
    std::map<int, std::vector<Seen>> advances; // of a sequence
    std::map<int, std::uint32_t> origins;
    std::set<int> present;
    for (const SentDatagram& datagram : arrivals) {
        ++counts.datagrams;
        counts.bytes += 760;
        const int place = sequenceOfRun[static_cast<std::size_t>(datagram.run)];
        const std::uint32_t origin = origins.try_emplace(place, datagram.sample).first->second;
        const std::int64_t position =
            std::int64_t{origin} + static_cast<std::int32_t>(datagram.sample - origin);
        present.insert(place);
        Sample& sample = found[static_cast<std::size_t>(datagram.run)].samples[position];
        if (!sample.parts.insert(datagram.index).second) {
            counts.duplicates += place == *present.rbegin() ? 1 : 0; // a restart forgets what was before it
            continue;
        }
        sample.last = datagram.isLast ? datagram.index : sample.last;
        auto& seen = advances[place];
        if (seen.empty() || position > seen.back().position) {
            seen.push_back({position, datagram.stamp});
        } else if (position < seen.back().position) {
            ++counts.reordered;
            for (const Seen& larger : seen) {
                if (larger.position > position) {
                    counts.late += datagram.stamp - larger.stamp > std::chrono::milliseconds(50) ? 1 : 0;
                    break;
                }
            }
        }
    }
    counts.restarts = present.size() - 1;
    std::optional<std::uint32_t> first;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto& samples = found[i].samples;
        if (samples.empty()) {
            continue;
        }
        std::int64_t before = samples.begin()->first;
        for (const auto& [position, sample] : samples) {
            const bool isWhole = static_cast<int>(sample.parts.size()) == sample.last + 1;
            ++(isWhole ? counts.samples : counts.incomplete);
            if (position != before) {
                const auto missing = static_cast<std::uint64_t>((position - before) / runs[i].step - 1);
                counts.lost += missing;
                counts.longestGapSamples = std::max(counts.longestGapSamples, missing);
            }
            before = position;
        }
        first = first ? first : static_cast<std::uint32_t>(samples.begin()->first);
        counts.firstSample = *first;
        counts.lastSample = static_cast<std::uint32_t>(samples.rbegin()->first);
        counts.step = runs[i].step;
    }
    return counts;
}

} // namespace posewire::model
