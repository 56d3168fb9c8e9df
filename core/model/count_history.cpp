// SPDX-License-Identifier: MIT
#include "core/model/count_history.h"

#include <algorithm>
#include <cmath>

namespace posewire::model {
namespace {

constexpr double kMsPerNs = 1e-6;

std::int64_t aligned(std::int64_t stampNs, std::int64_t widthNs) {
    const std::int64_t rest = stampNs % widthNs;
    return stampNs - (rest < 0 ? rest + widthNs : rest);
}

} // namespace

void CountHistory::apply(Bucket& bucket, const Change& change) {
    bucket.datagrams += static_cast<std::uint32_t>(change.datagrams);
    bucket.bytes += static_cast<std::uint64_t>(change.bytes);
    bucket.samples += static_cast<std::uint32_t>(change.samples);
    bucket.lost += static_cast<std::uint32_t>(change.lost);
    bucket.duplicates += static_cast<std::uint32_t>(change.duplicates);
    bucket.reordered += static_cast<std::uint32_t>(change.reordered);
    bucket.late += static_cast<std::uint32_t>(change.late);
    bucket.incomplete += static_cast<std::uint32_t>(change.incomplete);
    bucket.restarts += static_cast<std::uint32_t>(change.restarts);
}

/// The newest bucket, made where the stamp is beyond it; an earlier stamp makes none.
CountHistory::Bucket& CountHistory::bucketAt(std::int64_t stampNs) {
    if (m_buckets.empty()) {
        Bucket& first = m_buckets.emplace_back();
        first.startNs = aligned(stampNs, m_widthNs);
    } else if (stampNs >= m_buckets.back().startNs + m_widthNs) {
        if (m_buckets.size() == kMostBuckets) {
            halve();
        }
        if (stampNs >= m_buckets.back().startNs + m_widthNs) {
            Bucket next = m_buckets.back();
            next.startNs = aligned(stampNs, m_widthNs);
            next.longestGap = 0;
            next.leastMs = next.mostMs = 0;
            next.hasArrivals = false;
            m_buckets.push_back(next);
        }
    }
    return m_buckets.back();
}

void CountHistory::halve() {
    while (m_buckets.size() > kMostBuckets / 2) {
        m_widthNs *= 2;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < m_buckets.size(); ++i) {
            Bucket bucket = m_buckets[i];
            bucket.startNs = aligned(bucket.startNs, m_widthNs);
            if (kept != 0 && m_buckets[kept - 1].startNs == bucket.startNs) {
                const Bucket& before = m_buckets[kept - 1];
                bucket.longestGap = std::max(bucket.longestGap, before.longestGap);
                if (before.hasArrivals) {
                    bucket.leastMs =
                        bucket.hasArrivals ? std::min(bucket.leastMs, before.leastMs) : before.leastMs;
                    bucket.mostMs = std::max(bucket.mostMs, before.mostMs);
                    bucket.hasArrivals = true;
                }
                --kept;
            }
            m_buckets[kept++] = bucket;
        }
        m_buckets.resize(kept);
    }
}

void CountHistory::add(std::int64_t stampNs, const Change& change) {
    Bucket& newest = bucketAt(stampNs);
    if (stampNs >= newest.startNs) {
        apply(newest, change);
        return;
    }
    const std::size_t after = firstFrom(stampNs + 1);
    for (std::size_t i = after == 0 ? 0 : after - 1; i < m_buckets.size(); ++i) {
        apply(m_buckets[i], change);
    }
}

void CountHistory::addGap(std::int64_t stampNs, std::uint32_t samples) {
    Bucket& bucket = bucketAt(stampNs);
    bucket.longestGap = std::max(bucket.longestGap, samples);
}

void CountHistory::addArrival(std::int64_t stampNs, std::int64_t sinceNs, double jitterMs) {
    Bucket& bucket = bucketAt(stampNs);
    const double since = static_cast<double>(sinceNs) * kMsPerNs;
    const auto shown = static_cast<float>(since);
    bucket.sumNs += static_cast<std::uint64_t>(sinceNs);
    bucket.sumSquares += since * since;
    ++bucket.arrivals;
    bucket.leastMs = bucket.hasArrivals ? std::min(bucket.leastMs, shown) : shown;
    bucket.mostMs = std::max(bucket.mostMs, shown);
    bucket.jitterMs = static_cast<float>(jitterMs);
    bucket.hasArrivals = true;
}

std::size_t CountHistory::firstFrom(std::int64_t stampNs) const {
    const auto found =
        std::lower_bound(m_buckets.begin(), m_buckets.end(), stampNs,
                         [](const Bucket& bucket, std::int64_t stamp) { return bucket.startNs < stamp; });
    return static_cast<std::size_t>(found - m_buckets.begin());
}

StreamCounts CountHistory::countsBetween(std::int64_t fromNs, std::int64_t toNs) const {
    const std::size_t first = firstFrom(fromNs);
    const std::size_t end = firstFrom(toNs);
    StreamCounts counts;
    if (end <= first) {
        return counts;
    }
    const Bucket before = first == 0 ? Bucket{} : m_buckets[first - 1];
    const Bucket& last = m_buckets[end - 1];
    counts.datagrams = last.datagrams - before.datagrams;
    counts.bytes = last.bytes - before.bytes;
    counts.samples = last.samples - before.samples;
    counts.lost = last.lost - before.lost;
    counts.duplicates = last.duplicates - before.duplicates;
    counts.reordered = last.reordered - before.reordered;
    counts.late = last.late - before.late;
    counts.incomplete = last.incomplete - before.incomplete;
    counts.restarts = last.restarts - before.restarts;
    for (std::size_t i = first; i < end; ++i) {
        counts.longestGapSamples = std::max<std::uint64_t>(counts.longestGapSamples, m_buckets[i].longestGap);
    }
    return counts;
}

InterArrival CountHistory::arrivalsBetween(std::int64_t fromNs, std::int64_t toNs) const {
    const std::size_t first = firstFrom(fromNs);
    const std::size_t end = firstFrom(toNs);
    InterArrival result;
    if (end <= first) {
        return result;
    }
    const Bucket before = first == 0 ? Bucket{} : m_buckets[first - 1];
    const Bucket& last = m_buckets[end - 1];
    result.count = last.arrivals - before.arrivals;
    if (result.count == 0) {
        return result;
    }
    const auto count = static_cast<double>(result.count);
    result.meanMs = static_cast<double>(last.sumNs - before.sumNs) * kMsPerNs / count;
    const double squares = (last.sumSquares - before.sumSquares) / count;
    result.deviationMs = std::sqrt(std::max(0.0, squares - result.meanMs * result.meanMs));
    bool isFirst = true;
    for (std::size_t i = first; i < end; ++i) {
        const Bucket& bucket = m_buckets[i];
        if (bucket.hasArrivals) {
            const auto least = static_cast<double>(bucket.leastMs);
            result.leastMs = isFirst ? least : std::min(result.leastMs, least);
            result.mostMs = std::max(result.mostMs, static_cast<double>(bucket.mostMs));
            isFirst = false;
        }
    }
    return result;
}

double CountHistory::jitterMsAt(std::int64_t toNs) const {
    const std::size_t end = firstFrom(toNs);
    return end == 0 ? 0 : static_cast<double>(m_buckets[end - 1].jitterMs);
}

} // namespace posewire::model
