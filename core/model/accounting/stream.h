// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/stream_index.h"
#include "core/model/accounting/stream_accounting.h"
#include "core/model/message.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace posewire::model {

/// From receive stamps alone. O(1) in time and memory for each packet.
class StreamStatistics {
public:
    /// Adds a datagram.
    void add(log::Stamp stamp) { m_lastStamp = std::max(m_lastStamp, stamp); }
    /// Adds a sample, or message, when its first datagram came; duplicates are none.
    void addSample(log::Stamp stamp);

    /// Samples a second over the window of the newest samples (at most 256 and at most about 2 s before the
    /// newest); 0 before the second sample.
    [[nodiscard]] double rateHz() const;

private:
    static constexpr std::size_t kMostSamples = 256;
    [[nodiscard]] std::size_t windowSize() const;
    [[nodiscard]] log::Stamp arrival(std::size_t back) const {
        return m_arrivals[(m_samples - 1 - back) % kMostSamples];
    }

    std::uint64_t m_samples = 0;
    log::Stamp m_lastStamp{};
    std::array<log::Stamp, kMostSamples> m_arrivals{};
};

/// One message type of one character of one sender.
/// Without data for this long a stream is stale (seconds).
inline constexpr double kStaleAge = 1.0;
/// A slow stream is given the time of two and a half samples (seconds); `rateHz` 0 where it is not known.
[[nodiscard]] constexpr double patienceAt(double rateHz) {
    return rateHz > 0 ? 2.5 / rateHz : 0.0;
}

struct Stream {
    explicit Stream(const log::StreamKey& streamKey) : key(streamKey), accounting(streamKey.type) {}

    log::StreamKey key;
    StreamStatistics statistics; ///< how fast it is now
    StreamAccounting accounting; ///< what came and what did not
    /// Samples lost or incomplete whose cause was found, by LossCause; all others are Unknown.
    std::array<std::uint64_t, kLossCauses> attributed{};

    /// All samples lost and incomplete by LossCause.
    [[nodiscard]] LossesByCause lostByCause() const;
    /// Adds to the statistics what the accounting found with a datagram.
    void addSamples(log::Stamp stamp, const wire::Header& header, std::span<const Verdict> verdicts);
    /// By arrival, as StreamStatistics has it; 0 once it is stale at `now`.
    [[nodiscard]] double rateAt(log::Stamp now) const;

    /// So much came of it that something is missing where no more does; a corrupt header may have invented it
    /// before.
    [[nodiscard]] bool isEstablished() const { return accounting.datagrams() >= 10; }

    Message newest;              ///< its newest datagram as it was decoded; see Ingest::newest
    std::size_t newestBytes = 0; ///< of the largest that was in there, as it was sent

    // What others remember of it.
    std::uint64_t judgeAt = UINT64_MAX; ///< Attribution: this many datagrams; what waits is judged then
    std::uint32_t judgedStep = 0;       ///< Attribution: the step by which its gaps were counted
    std::uint64_t openPartial =
        0; ///< Attribution: one past the number of the partial that its next sample ends
    std::uint64_t restSamples = 0;  ///< Attribution: lost in hindsight, without a gap
    std::uint64_t restIncident = 0; ///< Attribution: that these are told in
    bool awaitsRest = false;        ///< Attribution
    std::uint32_t evenSpacing = 0;  ///< Attribution: what the newest differences are multiples of, all gaps
    std::uint32_t evenGaps = 0;     ///< Attribution: that many are
    std::uint64_t judgedMessage = UINT64_MAX; ///< Attribution: its first packet, where the rest is lost
    double usualHz = 0;              ///< ThresholdWatch: its rate before the window; 0 before it is known
    bool isWatched = false;          ///< ThresholdWatch
    log::Stamp excusedUntil{};       ///< ThresholdWatch: an incident says why it is not as it should be
    std::uint32_t toldStep = 0;      ///< IncidentFollower
    std::uint64_t toldStepSince = 0; ///< IncidentFollower: that many datagrams when it was first so
    bool isFollowed = false;         ///< IncidentFollower
    bool isUneven = false;           ///< IncidentFollower: it had a step
    bool isStalled = false;          ///< IncidentFollower: missing for a moment, while others go on
    bool hasEnded = false;           ///< IncidentFollower: others of its character go on
};

} // namespace posewire::model
