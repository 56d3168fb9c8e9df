// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/wire/type_table.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace posewire::model {

/// The end does not belong to it.
struct TimeRange {
    log::Stamp from{};
    log::Stamp to{};

    [[nodiscard]] double seconds() const { return log::secondsOf(to - from); }
    friend bool operator==(const TimeRange&, const TimeRange&) = default;
};

/// Whose loss it was. Transport is the way from a probe to here. Unknown is an answer: nothing is guessed.
enum class LossCause : std::uint8_t { ThisComputer, Network, Sender, Unknown, Transport };
inline constexpr std::size_t kLossCauses = 5;

/// Samples by LossCause.
using LossesByCause = std::array<std::uint64_t, kLossCauses>;

/// "this computer", "network", "sender", "unknown", "transport".
[[nodiscard]] std::string_view nameOf(LossCause cause);

/// True if sample accounting applies to a message type: types 10 to 13 carry sample 0 and are sent again and
/// again on purpose.
[[nodiscard]] inline bool countsSamples(std::uint8_t type) {
    return wire::isSampled(type);
}

/// A sum has the step and the samples 0.
struct StreamCounts {
    std::uint64_t datagrams = 0; ///< well-formed ones, duplicates included
    std::uint64_t bytes = 0;
    std::uint64_t samples = 0; ///< sample counters of which all datagrams arrived
    std::uint64_t lost = 0;    ///< expected between the first and the last of a run, of which nothing arrived
    std::uint64_t duplicates = 0; ///< same sample and datagram counter as one before
    std::uint64_t reordered = 0;  ///< first arrivals below the highest sample counter (RFC 4737 §3)
    std::uint64_t late = 0;       ///< reordered by more than the display's waiting time
    std::uint64_t incomplete =
        0; ///< sample counters, or messages, of which some but not all datagrams arrived
    std::uint64_t restarts = 0;
    /// Most samples lost in a row; of an irregular stream the longest difference of sample counters.
    std::uint64_t longestGapSamples = 0;
    std::uint32_t step = 0;        ///< of the newest run; 0 if there is none: irregular, or one sample
    std::uint32_t firstSample = 0; ///< as on the wire
    std::uint32_t lastSample = 0;  ///< the highest of the newest run, as on the wire

    /// Samples that should have come.
    [[nodiscard]] std::uint64_t expected() const { return samples + incomplete + lost; }
    /// Of those, the share of which nothing or not all came; 0 if none were expected.
    [[nodiscard]] double lossRatio() const {
        return expected() == 0 ? 0 : static_cast<double>(lost + incomplete) / static_cast<double>(expected());
    }

    StreamCounts& operator+=(const StreamCounts& other);
    friend bool operator==(const StreamCounts&, const StreamCounts&) = default;
};

/// Bursts and gaps of loss as RFC 3611 §4.7.2 with Gmin = 16: a burst begins and ends with a loss and has
/// fewer than 16 samples received in a row; all else is gap.
struct LossPattern {
    std::uint64_t bursts = 0;
    double burstDensity = 0;     ///< share of the samples in bursts that were lost
    double gapDensity = 0;       ///< share of the samples in gaps that were lost
    double meanBurstSamples = 0; ///< length of a burst
};

/// Sums over bursts.
struct BurstCounts {
    std::uint64_t bursts = 0;
    std::uint64_t lost = 0;
    std::uint64_t samples = 0; ///< from the first to the last loss of each
};
/// Of the bursts, among all that was lost and all that arrived.
[[nodiscard]] LossPattern patternOf(const BurstCounts& bursts, const StreamCounts& counts);

/// Time between the first arrivals of successive samples.
struct InterArrival {
    std::uint64_t count = 0;
    double meanMs = 0;
    double leastMs = 0;
    double mostMs = 0;
    double deviationMs = 0;
};

/// How much faster the sender's clock goes than ours, in parts per million, and what that made. Both are 0
/// if it is not known: where only the sample counter shows the sender's time, and as long as delays on the
/// way hide it; and if it is less than twice its own error, so that none is seen.
struct ClockSkew {
    double skewPpm = 0;
    double driftMs = 0;
    double errorPpm = std::numeric_limits<double>::infinity(); ///< standard error, also of none

    [[nodiscard]] bool isKnown() const { return std::isfinite(errorPpm); }
};

/// The sender's clock against ours.
struct ClockFigures {
    bool isFromTimeCode = false; ///< else the sample counter times its own period is the sender's clock
    double jitterMs = 0;         ///< RFC 3550 §6.4.1
    ClockSkew skew{};
};

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

/// How much of each stream is remembered. Counts do not depend on it: how late a datagram may come, and how
/// fine ranges of time are, do. The more streams there are the less it is, so that all of them together take
/// about as much as kFullStreams.
struct AccountingDepth {
    /// As many streams are remembered in full.
    static constexpr std::size_t kFullStreams = 512;

    std::size_t samples = 4096; ///< the newest, before and after a restart each; a power of two from 512 on
    std::size_t buckets = 2048; ///< of time in a history

    friend bool operator==(const AccountingDepth&, const AccountingDepth&) = default;

    /// For that many streams, which are kStreamLimit at most.
    [[nodiscard]] static constexpr AccountingDepth of(std::size_t streams) {
        AccountingDepth depth;
        for (std::size_t most = kFullStreams; streams > most && depth.samples > 512; most *= 2) {
            depth.samples /= 2;
            depth.buckets /= 2;
        }
        return depth;
    }
};

} // namespace posewire::model
