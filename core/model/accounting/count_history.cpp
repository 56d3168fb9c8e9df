// SPDX-License-Identifier: MIT
#include "core/model/accounting/count_history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace posewire::model {
namespace {

/// A new one, one that stays as it is, and one for all before.
constexpr std::size_t kLeastBuckets = 3;

using Counters = CountHistory::Counters;

constexpr std::array kCounters{&Counters::datagrams,  &Counters::samples,   &Counters::lost,
                               &Counters::duplicates, &Counters::reordered, &Counters::late,
                               &Counters::incomplete, &Counters::restarts,  &Counters::malformed,
                               &Counters::bursts,     &Counters::burstLost, &Counters::burstSamples,
                               &Counters::arrivals};

/// Once, or -1 times to subtract.
void add(Counters& counters, const Counters& part, int times = 1) {
    counters.bytes += static_cast<std::uint64_t>(times) * part.bytes;
    for (const auto counter : kCounters) {
        counters.*counter += static_cast<std::uint32_t>(times) * part.*counter;
    }
    counters.sum += times * part.sum;
    counters.sumSquares += times * part.sumSquares;
}

} // namespace

log::Stamp roundedDown(log::Stamp stamp, log::Duration width) {
    const log::Duration rest = stamp.time_since_epoch() % width;
    return stamp - (rest < log::Duration::zero() ? rest + width : rest);
}

log::Stamp roundedUp(log::Stamp stamp, log::Duration width) {
    const log::Stamp down = roundedDown(stamp, width);
    return down < stamp ? down + width : down;
}

log::Duration roundedUp(log::Duration time, log::Duration width) {
    return roundedUp(log::Stamp(time), width).time_since_epoch();
}

log::Stamp CountHistory::roundedUp(log::Stamp stamp) const {
    return stamp == m_edges.from || stamp == m_edges.to ? stamp
           : stamp < m_fineFrom ? std::min(model::roundedUp(stamp, m_width), m_fineFrom)
                                : model::roundedUp(stamp, kFirstWidth);
}

log::Stamp CountHistory::beginOf(log::Stamp stamp, log::Duration width) const {
    const log::Stamp begin = roundedDown(stamp, width);
    return stamp >= m_edges.to     ? std::max(begin, m_edges.to)
           : stamp >= m_edges.from ? std::max(begin, m_edges.from)
                                   : begin;
}

/// The newest bucket, made where the stamp is beyond it; an earlier stamp makes none.
CountHistory::Bucket& CountHistory::bucketAt(log::Stamp stamp) {
    if (!m_buckets.empty() && stamp < m_newestEnd) {
        return m_buckets.back();
    }
    const log::Stamp begin = beginOf(stamp, kFirstWidth);
    m_newestEnd = roundedDown(stamp, kFirstWidth) + kFirstWidth;
    for (const log::Stamp edge : {m_edges.to, m_edges.from}) {
        m_newestEnd = edge > begin ? std::min(m_newestEnd, edge) : m_newestEnd;
    }
    if (m_buckets.empty()) {
        m_buckets.emplace_back().start = begin;
    } else {
        if (m_buckets.size() >= m_most) {
            coarsen();
        }
        Bucket next;
        next.start = begin;
        next.counters = m_buckets.back().counters;
        next.jitterMs = m_buckets.back().jitterMs;
        m_buckets.push_back(next);
    }
    return m_buckets.back();
}

/// Into a bucket, the one before it.
void CountHistory::merge(Bucket& bucket, const Bucket& before) {
    bucket.longestGap = std::max(bucket.longestGap, before.longestGap);
    bucket.leastMs = std::min(bucket.leastMs, before.leastMs);
    bucket.mostMs = std::max(bucket.mostMs, before.mostMs);
    const bool isLess = !bucket.hasDifference ||
                        (bucket.generation == before.generation && before.differenceMs < bucket.differenceMs);
    if (before.hasDifference && isLess) {
        bucket.hasDifference = true;
        bucket.generation = before.generation;
        bucket.leastDelayed = before.leastDelayed;
        bucket.differenceMs = before.differenceMs;
    }
}

/// Joins the buckets that the previous edges had split.
void CountHistory::setEdges(const TimeRange& range) {
    for (const log::Stamp edge : {m_edges.from, m_edges.to}) {
        const std::size_t i = firstFrom(edge);
        if (i == m_buckets.size() || m_buckets[i].start != edge) {
            continue;
        }
        m_buckets[i].start = roundedDown(edge, widthOf(i));
        if (i > 0 && m_buckets[i - 1].start >= m_buckets[i].start) {
            merge(m_buckets[i], m_buckets[i - 1]);
            m_buckets[i].start = m_buckets[i - 1].start;
            m_buckets.erase(m_buckets.begin() + static_cast<std::ptrdiff_t>(i - 1));
        }
    }
    m_edges = range;
}

/// The newer half stays as it is; of the older one little enough is left that much has to come until the next
/// time.
void CountHistory::coarsen() {
    const std::size_t fine = std::max<std::size_t>(1, m_most / 2);
    if (m_buckets.size() <= fine) {
        return;
    }
    std::size_t old = m_buckets.size() - fine;
    m_fineFrom = roundedDown(m_buckets[old].start, kFirstWidth);
    while (true) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < old; ++i) {
            Bucket bucket = m_buckets[i];
            bucket.start = beginOf(bucket.start, m_width);
            if (kept != 0 && m_buckets[kept - 1].start == bucket.start) {
                merge(bucket, m_buckets[kept - 1]);
                --kept;
            }
            m_buckets[kept++] = bucket;
        }
        m_buckets.erase(m_buckets.begin() + static_cast<std::ptrdiff_t>(kept),
                        m_buckets.begin() + static_cast<std::ptrdiff_t>(old));
        old = kept;
        if (old <= m_most * 3 / 8) {
            return;
        }
        m_width *= 2;
    }
}

void CountHistory::setMost(std::size_t buckets) {
    m_most = std::max(buckets, kLeastBuckets);
    if (m_buckets.size() > m_most) {
        coarsen();
    }
    if (m_buckets.capacity() > m_most) {
        std::vector<Bucket> kept;
        kept.reserve(m_most);
        kept.assign(m_buckets.begin(), m_buckets.end());
        m_buckets = std::move(kept);
    }
}

void CountHistory::add(log::Stamp stamp, const Counters& change) {
    Bucket& newest = bucketAt(stamp);
    if (stamp >= newest.start) {
        model::add(newest.counters, change);
        return;
    }
    const std::size_t after = firstFrom(stamp + log::Duration(1));
    for (std::size_t i = after == 0 ? 0 : after - 1; i < m_buckets.size(); ++i) {
        model::add(m_buckets[i].counters, change);
    }
}

void CountHistory::addGap(log::Stamp stamp, std::uint32_t samples) {
    Bucket& bucket = bucketAt(stamp);
    bucket.longestGap = std::max(bucket.longestGap, samples);
}

void CountHistory::addArrival(log::Stamp stamp, log::Duration since, double jitterMs) {
    Bucket& bucket = bucketAt(stamp);
    const double sinceMs = log::millisecondsOf(since);
    const auto shown = static_cast<float>(sinceMs);
    bucket.counters.sum += since;
    bucket.counters.sumSquares += sinceMs * sinceMs;
    ++bucket.counters.arrivals;
    bucket.leastMs = std::min(bucket.leastMs, shown);
    bucket.mostMs = std::max(bucket.mostMs, shown);
    bucket.jitterMs = static_cast<float>(jitterMs);
}

void CountHistory::addDifference(log::Stamp stamp, double differenceMs, std::uint32_t generation) {
    Bucket& bucket = bucketAt(stamp);
    if (!bucket.hasDifference || bucket.generation != generation || differenceMs < bucket.differenceMs) {
        bucket.hasDifference = true;
        bucket.generation = generation;
        bucket.leastDelayed = stamp;
        bucket.differenceMs = differenceMs;
    }
}

std::size_t CountHistory::firstFrom(log::Stamp stamp) const {
    const auto found = std::ranges::lower_bound(m_buckets, stamp, {}, &Bucket::start);
    return static_cast<std::size_t>(found - m_buckets.begin());
}

const CountHistory::Bucket& CountHistory::before(std::size_t index) const {
    static const Bucket none;
    return index == 0 ? none : m_buckets[index - 1];
}

Counters CountHistory::between(log::Stamp from, log::Stamp to) const {
    const std::size_t first = firstFrom(from);
    Counters result = before(std::max(first, firstFrom(to))).counters;
    model::add(result, before(first).counters, -1);
    return result;
}

CountHistory::Bucket CountHistory::sumOf(log::Stamp from, log::Stamp to) const {
    const std::size_t first = firstFrom(from);
    const std::size_t end = std::max(first, firstFrom(to));
    if (first == end) {
        return {};
    }
    Bucket result = m_buckets[end - 1];
    result.counters = between(from, to);
    for (std::size_t i = first; i + 1 < end; ++i) {
        merge(result, m_buckets[i]);
    }
    return result;
}

void CountHistory::cutAt(log::Stamp edge, const CountHistory& exact, const TimeRange& read) {
    if (m_buckets.size() >= m_most) {
        coarsen();
    }
    const std::size_t next = firstFrom(edge);
    if (next == 0) {
        return;
    }
    Bucket& after = m_buckets[next - 1]; // keeps the part after the edge
    log::Stamp end = roundedDown(after.start, widthOf(next - 1)) + widthOf(next - 1);
    end = next < m_buckets.size() ? std::min(end, m_buckets[next].start) : end;
    if (edge >= end || after.start < read.from || end > read.to) {
        return;
    }
    const Bucket earlier = before(next - 1);
    const Bucket rest = exact.sumOf(edge, end);
    Bucket cut = exact.sumOf(after.start, edge);
    for (const auto counter : kCounters) { // at most our own count, and all of it if none came after the edge
        const auto whole = static_cast<std::int32_t>(after.counters.*counter - earlier.counters.*counter);
        const auto part = static_cast<std::int32_t>(cut.counters.*counter);
        const auto ours = std::clamp(part, std::min(whole, 0), std::max(whole, 0));
        cut.counters.*counter = static_cast<std::uint32_t>(rest.counters.*counter == 0 ? whole : ours);
    }
    cut.jitterMs = cut.counters.arrivals == 0 ? earlier.jitterMs : cut.jitterMs;
    model::add(cut.counters, earlier.counters);
    cut.start = std::exchange(after.start, edge);
    after.longestGap = rest.longestGap;
    after.leastMs = rest.leastMs;
    after.mostMs = rest.mostMs;
    // Clock differences of another history cannot be compared with ours.
    cut.hasDifference = after.hasDifference && after.leastDelayed < edge;
    after.hasDifference = after.hasDifference && !cut.hasDifference;
    cut.generation = after.generation;
    cut.leastDelayed = after.leastDelayed;
    cut.differenceMs = after.differenceMs;
    m_buckets.insert(m_buckets.begin() + static_cast<std::ptrdiff_t>(next - 1), cut);
}

StreamCounts CountHistory::countsBetween(log::Stamp from, log::Stamp to) const {
    const Bucket sum = sumOf(from, to);
    const Counters& came = sum.counters;
    StreamCounts counts;
    counts.datagrams = came.datagrams;
    counts.bytes = came.bytes;
    counts.samples = came.samples;
    counts.lost = came.lost;
    counts.duplicates = came.duplicates;
    counts.reordered = came.reordered;
    counts.late = came.late;
    counts.incomplete = came.incomplete;
    counts.restarts = came.restarts;
    counts.longestGapSamples = sum.longestGap;
    return counts;
}

BurstCounts CountHistory::burstsBetween(log::Stamp from, log::Stamp to) const {
    const Counters came = between(from, to);
    return {came.bursts, came.burstLost, came.burstSamples};
}

/// Where few samples came, maybe none came without delay: buckets with less than half of the usual number,
/// such as the last one of a stream, tell nothing of the clocks.
ClockSkew CountHistory::skewBetween(log::Stamp from, log::Stamp to) const {
    const std::size_t end = firstFrom(to);
    std::size_t first = end; // of the newest generation
    log::Duration seen{};
    for (std::size_t i = firstFrom(from); i < end; ++i) {
        if (m_buckets[i].hasDifference) {
            const bool isSame = first != end && m_buckets[first].generation == m_buckets[i].generation;
            first = isSame ? first : i;
            seen = (isSame ? seen : log::Duration::zero()) + widthOf(i);
        }
    }
    if (first == end) {
        return {};
    }
    const auto arrivalsIn = [this](std::size_t begin, std::size_t stop) {
        return static_cast<double>(
            std::uint32_t{before(stop).counters.arrivals - before(begin).counters.arrivals});
    };
    ClockFit fit(m_buckets[end - 1].start + widthOf(end - 1) - m_buckets[first].start);
    const double usualHz = arrivalsIn(first, end) / log::secondsOf(seen);
    for (std::size_t i = first; i < end; ++i) {
        if (m_buckets[i].hasDifference && 2 * arrivalsIn(i, i + 1) >= usualHz * log::secondsOf(widthOf(i))) {
            fit.add(m_buckets[i].leastDelayed, m_buckets[i].differenceMs);
        }
    }
    return fit.skew();
}

InterArrival CountHistory::arrivalsBetween(log::Stamp from, log::Stamp to) const {
    const Bucket sum = sumOf(from, to);
    InterArrival result;
    result.count = sum.counters.arrivals;
    if (result.count == 0) {
        return result;
    }
    const auto count = static_cast<double>(result.count);
    result.meanMs = log::millisecondsOf(sum.counters.sum) / count;
    const double squares = sum.counters.sumSquares / count;
    result.deviationMs = std::sqrt(std::max(0.0, squares - result.meanMs * result.meanMs));
    result.leastMs = static_cast<double>(sum.leastMs);
    result.mostMs = static_cast<double>(sum.mostMs);
    return result;
}

double CountHistory::jitterMsAt(log::Stamp to) const {
    return static_cast<double>(before(firstFrom(to)).jitterMs);
}

} // namespace posewire::model
