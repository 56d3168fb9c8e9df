// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/sender_clock.h"
#include "core/model/accounting/stream_counts.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace posewire::model {

/// The beginning of the bucket of a width that a stamp is in.
[[nodiscard]] log::Stamp roundedDown(log::Stamp stamp, log::Duration width);
/// The next one, or the stamp itself where a bucket begins there.
[[nodiscard]] log::Stamp roundedUp(log::Stamp stamp, log::Duration width);
/// The least multiple of a width that is no shorter than a time of 0 or more.
[[nodiscard]] log::Duration roundedUp(log::Duration time, log::Duration width);

/// Counts of a stream so far at the ends of buckets of time, so that those of any range are the difference of
/// two. Bounded: the newest half of them are 0.1 s wide, and those before are merged into ever wider ones, so
/// that figures of now are as exact after a day as in the first minute.
class CountHistory {
public:
    static constexpr log::Duration kFirstWidth = std::chrono::milliseconds(100);

    /// What changes at one moment, or has come so far. Modulo 2^32, so that differences are right; one that
    /// goes down, where a loss turns out to be none, wraps.
    struct Counters {
        std::uint64_t bytes = 0;
        std::uint32_t datagrams = 0;
        std::uint32_t samples = 0;
        std::uint32_t lost = 0;
        std::uint32_t duplicates = 0;
        std::uint32_t reordered = 0;
        std::uint32_t late = 0;
        std::uint32_t incomplete = 0;
        std::uint32_t restarts = 0;
        std::uint32_t malformed = 0;
        std::uint32_t bursts = 0; ///< see BurstCounts
        std::uint32_t burstLost = 0;
        std::uint32_t burstSamples = 0;
        std::uint32_t arrivals = 0; ///< inter-arrival times
        log::Duration sum{};        ///< of them
        double sumSquares = 0;      ///< ms²
    };
    void add(log::Stamp stamp, const Counters& change);
    void addGap(log::Stamp stamp, std::uint32_t samples);
    /// Time since the sample before, and the jitter as it is now.
    void addArrival(log::Stamp stamp, log::Duration since, double jitterMs);

    /// How far our clock is ahead of the sender's. Only differences of one generation can be compared.
    void addDifference(log::Stamp stamp, double differenceMs, std::uint32_t generation);

    /// Figures of the buckets that begin in [from, to). Without step, first and last sample.
    [[nodiscard]] StreamCounts countsBetween(log::Stamp from, log::Stamp to) const;
    [[nodiscard]] InterArrival arrivalsBetween(log::Stamp from, log::Stamp to) const;
    [[nodiscard]] BurstCounts burstsBetween(log::Stamp from, log::Stamp to) const;
    [[nodiscard]] std::uint64_t malformedBetween(log::Stamp from, log::Stamp to) const {
        return between(from, to).malformed;
    }
    [[nodiscard]] ClockSkew skewBetween(log::Stamp from, log::Stamp to) const;
    /// At the end of the range.
    [[nodiscard]] double jitterMsAt(log::Stamp to) const;
    /// The widest of buckets from a stamp on.
    [[nodiscard]] log::Duration width(log::Stamp from = log::Stamp::min()) const {
        return from < m_fineFrom ? m_width : kFirstWidth;
    }
    /// Where a range that begins or ends at a stamp does so in fact: where the next bucket begins.
    [[nodiscard]] log::Stamp roundedUp(log::Stamp stamp) const;

    /// Buckets of what comes from now on begin at both ends of a range too, so that its counts are exact.
    void setEdges(const TimeRange& range);
    /// Splits the bucket that an edge is in. `exact` has counted all packets in `read` with the same edges; a
    /// bucket that reaches beyond `read` is not split.
    void cutAt(log::Stamp edge, const CountHistory& exact, const TimeRange& read);
    /// How many buckets there may be; three if fewer.
    void setMost(std::size_t buckets);
    [[nodiscard]] std::size_t memoryBytes() const { return m_buckets.capacity() * sizeof(Bucket); }
    [[nodiscard]] static constexpr std::size_t mostBytes(std::size_t buckets) {
        return buckets * sizeof(Bucket);
    }

private:
    struct Bucket {
        log::Stamp start{};
        Counters counters{};
        // These are of this bucket alone:
        std::uint32_t longestGap = 0;
        float leastMs = std::numeric_limits<float>::infinity(); ///< where nothing came
        float mostMs = 0;
        float jitterMs = 0;
        bool hasDifference = false;
        std::uint32_t generation = 0;
        log::Stamp leastDelayed{}; ///< stamp of the least difference
        double differenceMs = 0;
    };
    /// The newest bucket before one, empty if there is none.
    [[nodiscard]] const Bucket& before(std::size_t index) const;
    [[nodiscard]] Counters between(log::Stamp from, log::Stamp to) const;
    /// Merges the buckets that begin in [from, to).
    [[nodiscard]] Bucket sumOf(log::Stamp from, log::Stamp to) const;
    static void merge(Bucket& bucket, const Bucket& before);
    Bucket& bucketAt(log::Stamp stamp);
    /// The beginning of the bucket that holds a stamp, if buckets are that wide.
    [[nodiscard]] log::Stamp beginOf(log::Stamp stamp, log::Duration width) const;
    void coarsen();
    [[nodiscard]] log::Duration widthOf(std::size_t index) const { return width(m_buckets[index].start); }
    /// Index of the first bucket that begins at or after a stamp.
    [[nodiscard]] std::size_t firstFrom(log::Stamp stamp) const;

    std::vector<Bucket> m_buckets;
    std::size_t m_most = AccountingDepth().buckets;
    TimeRange m_edges{log::Stamp::min(), log::Stamp::max()};
    log::Stamp m_newestEnd{};            ///< of the newest bucket
    log::Duration m_width = kFirstWidth; ///< of the buckets that begin before m_fineFrom
    log::Stamp m_fineFrom = log::Stamp::min();
};

} // namespace posewire::model
