// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/stream_counts.h"

#include <cstdint>
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
    };
    void add(std::int64_t stampNs, const Change& change);
    void addGap(std::int64_t stampNs, std::uint32_t samples);
    /// Time since the sample before, and the jitter as it is now.
    void addArrival(std::int64_t stampNs, std::int64_t sinceNs, double jitterMs);

    /// Figures of the buckets that begin in [fromNs, toNs). Without step, first and last sample.
    [[nodiscard]] StreamCounts countsBetween(std::int64_t fromNs, std::int64_t toNs) const;
    [[nodiscard]] InterArrival arrivalsBetween(std::int64_t fromNs, std::int64_t toNs) const;
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
        // Of this bucket alone:
        std::uint32_t longestGap = 0;
        float leastMs = 0;
        float mostMs = 0;
        float jitterMs = 0;
        bool hasArrivals = false;
    };
    static void apply(Bucket& bucket, const Change& change);
    Bucket& bucketAt(std::int64_t stampNs);
    void halve();
    /// Index of the first bucket that begins at or after a stamp.
    [[nodiscard]] std::size_t firstFrom(std::int64_t stampNs) const;

    std::vector<Bucket> m_buckets;
    std::int64_t m_widthNs = kFirstWidthNs;
};

} // namespace posewire::model
