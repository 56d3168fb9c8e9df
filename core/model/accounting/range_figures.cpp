// SPDX-License-Identifier: MIT
#include "core/model/accounting/range_figures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace posewire::model {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr double kSecondsPerNs = 1e-9;
constexpr std::size_t kMostParts = 120;

std::int64_t roundedUp(std::int64_t value, std::int64_t unit) {
    const std::int64_t rest = value % unit;
    return rest == 0 ? value : value - rest + (rest > 0 ? unit : 0);
}

std::int64_t roundedDown(std::int64_t value, std::int64_t unit) {
    const std::int64_t rest = value % unit;
    return value - (rest < 0 ? rest + unit : rest);
}

std::uint64_t unitsOf(const StreamCounts& counts) {
    return counts.samples + counts.incomplete != 0 ? counts.samples + counts.incomplete : counts.datagrams;
}

/// The part of the range in which the stream was on the air, as the history rounds it.
TimeRange onAir(const StreamAccounting& stream, const std::optional<TimeRange>& range) {
    TimeRange air{stream.firstStampNs(), stream.lastStampNs()};
    if (range) {
        const std::int64_t resolution = stream.resolutionNs();
        air.fromNs = std::max(air.fromNs, roundedUp(range->fromNs, resolution));
        air.toNs = std::min(air.toNs, roundedUp(range->toNs, resolution));
    }
    return air;
}

/// Between the first and the last of the stream there is one interval less than samples; where the range cuts
/// the stream, half an interval is beyond the cut.
void readMean(const StreamAccounting& stream, const TimeRange& air, const StreamCounts& counts,
              RateFigures& rate) {
    const double seconds = air.seconds();
    const double cut =
        (air.fromNs == stream.firstStampNs() ? 0.5 : 0.0) + (air.toNs == stream.lastStampNs() ? 0.5 : 0.0);
    const auto units = static_cast<double>(unitsOf(counts));
    if (seconds <= 0 || units <= 1) {
        return;
    }
    rate.meanHz = (units - cut) / seconds;
    const double share = (units - cut) / units;
    rate.datagramsPerSecond = static_cast<double>(counts.datagrams) * share / seconds;
    rate.bytesPerSecond = static_cast<double>(counts.bytes) * share / seconds;
}

void readSpread(const StreamAccounting& stream, const TimeRange& air, RateFigures& rate) {
    rate.leastHz = rate.mostHz = rate.meanHz;
    const std::int64_t resolution = stream.resolutionNs();
    const TimeRange whole{roundedUp(air.fromNs, resolution), roundedDown(air.toNs, resolution)};
    if (whole.toNs - whole.fromNs < kSecondNs) {
        return;
    }
    std::array<RangePart, kMostParts> counted{};
    RangeParts parts = partsOf(whole, kMostParts, kSecondNs, resolution);
    while (parts.count > 0 && parts.beginOf(parts.count) > whole.toNs) {
        --parts.count;
    }
    if (parts.count == 0) {
        return;
    }
    addParts(stream, parts, std::span(counted).first(parts.count));
    const double seconds = static_cast<double>(parts.widthNs) * kSecondsPerNs;
    double sum = 0;
    double squares = 0;
    for (std::size_t i = 0; i < parts.count; ++i) {
        const std::uint32_t units = counted[i].samples != 0 ? counted[i].samples : counted[i].datagrams;
        const double hz = units / seconds;
        rate.leastHz = i == 0 ? hz : std::min(rate.leastHz, hz);
        rate.mostHz = i == 0 ? hz : std::max(rate.mostHz, hz);
        sum += hz;
        squares += hz * hz;
    }
    const auto count = static_cast<double>(parts.count);
    rate.deviationHz = std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count)));
}

} // namespace

RangeFigures countedFigures(const StreamAccounting& stream, const std::optional<TimeRange>& range) {
    RangeFigures figures;
    if (range) {
        figures.counts = stream.countsBetween(range->fromNs, range->toNs);
        figures.arrivals = stream.interArrivalBetween(range->fromNs, range->toNs);
        figures.clock = stream.clockBetween(range->fromNs, range->toNs);
        figures.pattern = stream.lossPatternBetween(range->fromNs, range->toNs);
        figures.malformed = stream.malformedBetween(range->fromNs, range->toNs);
    } else {
        figures.counts = stream.counts();
        figures.arrivals = stream.interArrival();
        figures.clock = stream.clock();
        figures.pattern = stream.lossPattern();
        figures.malformed = stream.malformed();
    }
    return figures;
}

RangeFigures figuresOf(const StreamAccounting& stream, const std::optional<TimeRange>& range) {
    RangeFigures figures = countedFigures(stream, range);
    const TimeRange air = onAir(stream, range);
    readMean(stream, air, figures.counts, figures.rate);
    readSpread(stream, air, figures.rate);
    return figures;
}

RangePart& RangePart::operator+=(const RangePart& other) {
    datagrams += other.datagrams;
    samples += other.samples;
    lost += other.lost;
    return *this;
}

RangeParts partsOf(const TimeRange& range, std::size_t most, std::int64_t leastWidthNs,
                   std::int64_t resolutionNs) {
    RangeParts parts;
    parts.firstNs = roundedDown(range.fromNs, resolutionNs);
    const std::int64_t length = range.toNs - parts.firstNs;
    if (range.toNs <= range.fromNs || most == 0) {
        return {};
    }
    const auto wanted = static_cast<std::int64_t>(most);
    parts.widthNs = roundedUp(std::max(leastWidthNs, (length + wanted - 1) / wanted), resolutionNs);
    parts.count = static_cast<std::size_t>((length + parts.widthNs - 1) / parts.widthNs);
    return parts;
}

void addParts(const StreamAccounting& stream, const RangeParts& parts, std::span<RangePart> into) {
    const std::size_t count = std::min(parts.count, into.size());
    for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t begin = parts.beginOf(i);
        if (begin > stream.lastStampNs() || parts.beginOf(i + 1) <= stream.firstStampNs() - kSecondNs) {
            continue;
        }
        const StreamCounts counts = stream.countsBetween(begin, parts.beginOf(i + 1));
        into[i] += {static_cast<std::uint32_t>(counts.datagrams),
                    static_cast<std::uint32_t>(counts.samples + counts.incomplete),
                    static_cast<std::uint32_t>(counts.lost + counts.incomplete)};
    }
}

} // namespace posewire::model
