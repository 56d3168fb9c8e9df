// SPDX-License-Identifier: MIT
#include "core/model/accounting/range_figures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace posewire::model {
namespace {

constexpr std::size_t kMostSpans = 120;

std::uint64_t unitsOf(const StreamCounts& counts) {
    return counts.samples + counts.incomplete != 0 ? counts.samples + counts.incomplete : counts.datagrams;
}

/// The part of the range in which the stream was on the air, as the history rounds it.
TimeRange onAir(const StreamAccounting& stream, const std::optional<TimeRange>& range) {
    TimeRange air{stream.firstStamp(), stream.lastStamp()};
    if (range) {
        air.from = std::max(air.from, stream.roundedUp(range->from));
        air.to = std::min(air.to, stream.roundedUp(range->to));
    }
    return air;
}

/// Between the first and the last of the stream there is one interval less than samples; where the range cuts
/// the stream, half an interval is beyond the cut.
void readMean(const StreamAccounting& stream, const TimeRange& air, const StreamCounts& counts,
              RateFigures& rate) {
    const double seconds = air.seconds();
    const double cut =
        (air.from == stream.firstStamp() ? 0.5 : 0.0) + (air.to == stream.lastStamp() ? 0.5 : 0.0);
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
    const log::Duration resolution = stream.resolution(air.from);
    const TimeRange whole{roundedUp(air.from, resolution), roundedDown(air.to, resolution)};
    if (whole.to - whole.from < std::chrono::seconds(1)) {
        return;
    }
    std::array<RangePart, kMostSpans> counted{};
    RangeParts parts = partsOf(whole, kMostSpans, std::chrono::seconds(1), resolution);
    while (parts.count > 0 && parts.beginOf(parts.count) > whole.to) {
        --parts.count;
    }
    if (parts.count == 0) {
        return;
    }
    addParts(stream, parts, std::span(counted).first(parts.count));
    const double seconds = log::secondsOf(parts.width);
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
    figures.counts = stream.counts(range);
    figures.arrivals = stream.interArrival(range);
    figures.clock = stream.clock(range);
    figures.pattern = stream.lossPattern(range);
    figures.malformed = stream.malformed(range);
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

RangeParts partsOf(const TimeRange& range, std::size_t most, log::Duration leastWidth,
                   log::Duration resolution) {
    RangeParts parts;
    parts.first = roundedDown(range.from, resolution);
    const log::Duration length = range.to - parts.first;
    if (range.to <= range.from || most == 0) {
        return {};
    }
    const auto wanted = static_cast<std::int64_t>(most);
    parts.width = roundedUp(std::max(leastWidth, (length + log::Duration(wanted - 1)) / wanted), resolution);
    parts.count = static_cast<std::size_t>((length + parts.width - log::Duration(1)) / parts.width);
    return parts;
}

void addParts(const StreamAccounting& stream, const RangeParts& parts, std::span<RangePart> into) {
    const std::size_t count = std::min(parts.count, into.size());
    for (std::size_t i = 0; i < count; ++i) {
        const log::Stamp begin = parts.beginOf(i);
        if (begin > stream.lastStamp() ||
            parts.beginOf(i + 1) <= stream.firstStamp() - std::chrono::seconds(1)) {
            continue;
        }
        const StreamCounts counts = stream.countsBetween(begin, parts.beginOf(i + 1));
        into[i] += {static_cast<std::uint32_t>(counts.datagrams),
                    static_cast<std::uint32_t>(counts.samples + counts.incomplete),
                    static_cast<std::uint32_t>(counts.lost + counts.incomplete)};
    }
}

} // namespace posewire::model
