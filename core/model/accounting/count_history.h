// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/clock_skew.h"
#include "core/model/accounting/stream_counts.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::model {

/// Counts of a stream so far at the ends of buckets of time, so that those of any range are the difference of
/// two. Bounded: buckets begin with 0.1 s and double their width whenever there are too many.
class CountHistory {
public:
    static constexpr std::size_t kMostBuckets = 2048;
    static constexpr std::int64_t kFirstWidthNs = 100'000'000;

    /// What changes at one moment; members go down too where a loss turns out to be none.
    struct Change {
        std::int32_t datagrams = 0;
        std::int32_t bytes = 0;
        std::int32_t samples = 0;
        std::int32_t lost = 0;
        std::int32_t duplicates = 0;
        std::int32_t reordered = 0;
        std::int32_t late = 0;
        std::int32_t incomplete = 0;
        std::int32_t restarts = 0;
        std::int32_t malformed = 0;
        std::int32_t bursts = 0; ///< see BurstCounts
        std::int32_t burstLost = 0;
        std::int32_t burstSamples = 0;
    };
    void add(std::int64_t stampNs, const Change& change);
    void addGap(std::int64_t stampNs, std::uint32_t samples);
    /// Time since the sample before, and the jitter as it is now.
    void addArrival(std::int64_t stampNs, std::int64_t sinceNs, double jitterMs);

    /// How far our clock is ahead of the sender's. Only differences of one generation can be compared.
    void addDifference(std::int64_t stampNs, double differenceMs, std::uint32_t generation);

    /// Figures of the buckets that begin in [fromNs, toNs). Without step, first and last sample.
    [[nodiscard]] StreamCounts countsBetween(std::int64_t fromNs, std::int64_t toNs) const;
    [[nodiscard]] InterArrival arrivalsBetween(std::int64_t fromNs, std::int64_t toNs) const;
    [[nodiscard]] BurstCounts burstsBetween(std::int64_t fromNs, std::int64_t toNs) const;
    [[nodiscard]] std::uint64_t malformedBetween(std::int64_t fromNs, std::int64_t toNs) const;
    /// Of the newest generation in the range.
    [[nodiscard]] ClockSkew skewBetween(std::int64_t fromNs, std::int64_t toNs) const;
    /// At the end of the range.
    [[nodiscard]] double jitterMsAt(std::int64_t toNs) const;
    [[nodiscard]] std::int64_t widthNs() const { return m_widthNs; }

private:
    // Counters are modulo 2^32: their differences are right.
    struct Bucket {
        std::int64_t startNs = 0;
        std::uint64_t bytes = 0;
        std::uint64_t sumNs = 0;
        double sumSquares = 0; ///< ms²
        std::uint32_t datagrams = 0;
        std::uint32_t samples = 0;
        std::uint32_t lost = 0;
        std::uint32_t duplicates = 0;
        std::uint32_t reordered = 0;
        std::uint32_t late = 0;
        std::uint32_t incomplete = 0;
        std::uint32_t restarts = 0;
        std::uint32_t arrivals = 0;
        std::uint32_t malformed = 0;
        std::uint32_t bursts = 0;
        std::uint32_t burstLost = 0;
        std::uint32_t burstSamples = 0;
        // Of this bucket alone:
        std::uint32_t longestGap = 0;
        float leastMs = 0;
        float mostMs = 0;
        float jitterMs = 0;
        bool hasArrivals = false;
        bool hasDifference = false;
        std::uint32_t generation = 0;
        std::int64_t leastDelayedNs = 0; ///< stamp of the least difference
        double differenceMs = 0;
    };
    /// The buckets before a range and at its end; nothing where none is in it.
    struct Ends {
        Bucket before;
        Bucket last;
        std::size_t first = 0;
        std::size_t end = 0;
    };
    [[nodiscard]] std::optional<Ends> endsOf(std::int64_t fromNs, std::int64_t toNs) const;
    static void merge(Bucket& bucket, const Bucket& before);
    static void apply(Bucket& bucket, const Change& change);
    Bucket& bucketAt(std::int64_t stampNs);
    void halve();
    /// Index of the first bucket that begins at or after a stamp.
    [[nodiscard]] std::size_t firstFrom(std::int64_t stampNs) const;

    std::vector<Bucket> m_buckets;
    std::int64_t m_widthNs = kFirstWidthNs;
};

} // namespace posewire::model
