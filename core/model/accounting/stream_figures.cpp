// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posewire::model {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

template <auto Member>
double counted(const RangeFigures& read) {
    return static_cast<double>(read.counts.*Member);
}
template <auto Member>
double rate(const RangeFigures& read) {
    return read.rate.*Member;
}
template <auto Member>
double pattern(const RangeFigures& read) {
    return static_cast<double>(read.pattern.*Member);
}
template <auto Member>
double spacing(const RangeFigures& read) {
    return read.arrivals.count != 0 ? read.arrivals.*Member : kUnknown;
}
template <auto Member>
double clockOf(const RangeFigures& read) {
    return read.clock.isFromTimeCode && read.clock.skew.isKnown() ? read.clock.skew.*Member : kUnknown;
}
template <LossCause Cause>
double lostBy(const RangeFigures& read) {
    return static_cast<double>(read.lostByCause[static_cast<std::size_t>(Cause)]);
}
double jitter(const RangeFigures& read) {
    return read.clock.jitterMs;
}
double malformed(const RangeFigures& read) {
    return static_cast<double>(read.malformed);
}
double missing(const RangeFigures& read) {
    return static_cast<double>(read.counts.lost + read.counts.incomplete);
}
double lossPercent(const RangeFigures& read) {
    return 100 * read.counts.lossRatio();
}
double kilobytes(const RangeFigures& read) {
    return read.rate.bytesPerSecond / 1000;
}

using enum Figure;
using Form = FigureForm;
using Sum = FigureSum;
using Trouble = FigureTrouble;
using Of = FigureScope;
using Counts = StreamCounts;
using Rates = RateFigures;
using Pattern = LossPattern;
using Spacing = InterArrival;
using Clock = ClockSkew;

constexpr FigureStyle kCount;
constexpr FigureStyle kCounter{Form::Counter};
constexpr FigureStyle kHz{Form::Number, "Hz", {3, 2, 2}};
constexpr FigureStyle kMs{Form::Number, "ms", {4, 3, 2}};
constexpr FigureStyle kPercent{Form::Number, "%", {4, 3, 2}};
constexpr FigureStyle kBurstShare{Form::Share, "%", {4, 1, 2}};
constexpr FigureStyle kGapShare{Form::Share, "%", {4, 3, 3}};
constexpr FigureStyle kLength{Form::Number, "samples", {2, 1, 1}};
constexpr FigureStyle kMsLong{Form::Number, "ms", {4, 3, 3}};
constexpr FigureStyle kPpm{Form::Signed, "ppm", {2, 1, 1}};
constexpr FigureStyle kDrift{Form::Signed, "ms", {3, 3, 2}};
constexpr FigureStyle kHzShort{Form::Number, "Hz", {0, 2, 1}};
constexpr FigureStyle kHzLong{Form::Number, "Hz", {0, 2, 2}};
constexpr FigureStyle kPerSecond{Form::Number, "1/s", {0, 1, 1}};
constexpr FigureStyle kKilobytes{Form::Number, "kB/s", {0, 1, 1}};

constexpr const char* kGaps = "gap > 0";

constexpr std::array kRows{
    FigureRow{Datagrams, "datagrams", "Datagrams", kCount, Sum::Sum, Trouble::None,
              counted<&Counts::datagrams>, "Well-formed datagrams, duplicates included", Of::Messages},
    FigureRow{Samples, "samples", "Samples", kCount, Sum::Sum, Trouble::None, counted<&Counts::samples>,
              "Sample counters of which all datagrams arrived"},
    FigureRow{Lost, "lost", "Lost", kCount, Sum::Sum, Trouble::Odd, counted<&Counts::lost>,
              "Samples expected by the sender's own step, of which nothing arrived", Of::Samples, nullptr,
              kGaps, "Packets after a gap"},
    FigureRow{Duplicates, "duplicates", "Duplicates", kCount, Sum::Sum, Trouble::Odd,
              counted<&Counts::duplicates>,
              "Datagrams whose sample and datagram counter had been received before", Of::Messages, "Dupl.",
              "duplicate", "Duplicates"},
    FigureRow{Reordered, "reordered", "Reordered", kCount, Sum::Sum, Trouble::Odd,
              counted<&Counts::reordered>,
              "First arrivals below the highest sample counter so far (RFC 4737 section 3)", Of::Samples,
              "Reord.", "reordered", "Reordered packets"},
    FigureRow{Late, "late", "Late", kCount, Sum::Sum, Trouble::Warning, counted<&Counts::late>,
              "Reordered by more than the display waits, 50 ms (RFC 4737 section 4.3)", Of::Samples, nullptr,
              "reordered"},
    FigureRow{Incomplete, "incomplete", "Incomplete", kCount, Sum::Sum, Trouble::Warning,
              counted<&Counts::incomplete>, "Samples or messages of which some but not all datagrams arrived",
              Of::Messages, "Incompl."},
    FigureRow{Restarts, "restarts", "Restarts", kCount, Sum::Sum, Trouble::Warning,
              counted<&Counts::restarts>, "How often the sender's counter restarted (RFC 3550 appendix A.1)",
              Of::Samples, nullptr, "restart", "Restarts"},
    FigureRow{Step, "step", "Step", kCount, Sum::None, Trouble::None, counted<&Counts::step>,
              "The sender's own spacing of sample counters; 0 where it is irregular, so that nothing can be "
              "counted as lost"},
    FigureRow{RateWhole, "rateHz", "Hz", kHz, Sum::None, Trouble::None, rate<&Rates::meanHz>,
              "Complete samples, or datagrams of messages, per second from the first to the last",
              Of::Messages},
    FigureRow{Jitter, "jitterMs", "Jitter ms", kMs, Sum::Most, Trouble::None, jitter,
              "Interarrival jitter at the end of the range (RFC 3550 section 6.4.1); of a sum, that of its "
              "worst stream"},
    FigureRow{LongestGap, "longestGapSamples", "Longest gap", kCount, Sum::Most, Trouble::Odd,
              counted<&Counts::longestGapSamples>, "Most samples lost in a row", Of::Samples, nullptr, kGaps},
    FigureRow{FirstSample, "firstSample", "First", kCounter, Sum::None, Trouble::None,
              counted<&Counts::firstSample>, "First sample counter received"},
    FigureRow{LastSample, "lastSample", "Last", kCounter, Sum::None, Trouble::None,
              counted<&Counts::lastSample>, "Highest sample counter since the newest restart"},
    FigureRow{Bytes, "bytes", "Bytes", kCount, Sum::Sum, Trouble::None, counted<&Counts::bytes>,
              "Payload bytes of the datagrams", Of::Messages},
    FigureRow{Malformed, "malformed", "Malformed", kCount, Sum::Sum, Trouble::Error, malformed,
              "Datagrams that begin with MXTP and cannot be decoded", Of::Messages, nullptr, "malformed",
              "Malformed packets"},
    FigureRow{LossShare, "lossPercent", "Loss %", kPercent, Sum::Mean, Trouble::Warning, lossPercent,
              "Share of the samples expected of which nothing or not all arrived", Of::Samples, "Lost %",
              kGaps},
    FigureRow{LostHere, "causes.thisComputer", "Lost here", kCount, Sum::Sum, Trouble::Warning,
              lostBy<LossCause::ThisComputer>,
              "Samples, and messages in rows of their own, that this computer dropped", Of::Rows, "Here"},
    FigureRow{LostOnNetwork, "causes.network", "Lost on the network", kCount, Sum::Sum, Trouble::Odd,
              lostBy<LossCause::Network>, "Samples, and messages in rows of their own, that the network lost",
              Of::Rows, "Network"},
    FigureRow{LostAtSender, "causes.sender", "Lost at the sender", kCount, Sum::Sum, Trouble::Odd,
              lostBy<LossCause::Sender>,
              "Samples, and messages in rows of their own, that the sender never sent", Of::Rows, "Sender"},
    FigureRow{LostUnknown, "causes.unknown", "Lost of unknown cause", kCount, Sum::Sum, Trouble::Odd,
              lostBy<LossCause::Unknown>,
              "Samples, and messages in rows of their own, lost without evidence of the cause", Of::Rows,
              "Unknown"},
    FigureRow{
        LostOnWay, "causes.transport", "Lost on the way", kCount, Sum::Sum, Trouble::Odd,
        lostBy<LossCause::Transport>,
        "Samples, and messages in rows of their own, that a probe had received and that did not come here",
        Of::Rows, "Way"},
    FigureRow{Bursts, "bursts", "Bursts", kCount, Sum::Sum, Trouble::Odd, pattern<&Pattern::bursts>,
              "Periods in which losses were less than 16 samples apart (RFC 3611 section 4.7.2), counted "
              "where they ended",
              Of::Samples, nullptr, kGaps},
    FigureRow{BurstDensity, "burstDensity", "Burst %", kBurstShare, Sum::None, Trouble::None,
              pattern<&Pattern::burstDensity>,
              "Share of the samples in bursts that were lost (RFC 3611 section 4.7.2)", Of::Samples,
              "Burst dens. %", kGaps},
    FigureRow{GapDensity, "gapDensity", "Gap %", kGapShare, Sum::None, Trouble::None,
              pattern<&Pattern::gapDensity>,
              "Share of the samples between bursts that were lost (RFC 3611 section 4.7.2)", Of::Samples,
              "Gap dens. %", kGaps},
    FigureRow{BurstLength, "meanBurstSamples", "Burst length", kLength, Sum::None, Trouble::None,
              pattern<&Pattern::meanBurstSamples>,
              "Mean number of samples from the first to the last loss of a burst (RFC 3611 section 4.7.2)",
              Of::Samples, nullptr, kGaps},
    FigureRow{SpacingMean, "intervalMs.mean", "Mean ms", kMsLong, Sum::None, Trouble::None,
              spacing<&Spacing::meanMs>, "Mean time between the first arrivals of successive samples, ms",
              Of::Samples, "Spacing mean"},
    FigureRow{SpacingLeast, "intervalMs.least", "Least ms", kMs, Sum::None, Trouble::None,
              spacing<&Spacing::leastMs>,
              "Shortest time between the first arrivals of successive samples, ms", Of::Samples,
              "Spacing min."},
    FigureRow{SpacingMost, "intervalMs.most", "Most ms", kMs, Sum::Most, Trouble::None,
              spacing<&Spacing::mostMs>, "Longest time between the first arrivals of successive samples, ms",
              Of::Samples, "Spacing max."},
    FigureRow{SpacingDeviation, "intervalMs.deviation", "Deviation ms", kMs, Sum::None, Trouble::None,
              spacing<&Spacing::deviationMs>,
              "Standard deviation of the time between the first arrivals of successive samples, ms",
              Of::Samples, "Spacing dev."},
    FigureRow{Skew, "clock.skewPpm", "Skew ppm", kPpm, Sum::None, Trouble::None, clockOf<&Clock::skewPpm>,
              "How much faster the sender's clock runs than this computer's; known where the header's time "
              "code advances, and once delays on the way do not hide it"},
    FigureRow{Drift, "clock.driftMs", "Drift ms", kDrift, Sum::None, Trouble::None, clockOf<&Clock::driftMs>,
              "How far the skew moved the sender's clock in the range"},
    FigureRow{Missing, "", "Lost", kCount, Sum::Sum, Trouble::Odd, missing,
              "Samples expected of which nothing or not all arrived", Of::Samples, nullptr, kGaps},
    FigureRow{Rate, "", "Hz", kHzShort, Sum::None, Trouble::None, rate<&Rates::nowHz>,
              "Samples per second by arrival at this computer: over the newest 2 s, or the mean of the range",
              Of::Messages},
    FigureRow{RateMean, "", "Hz mean", kHzLong, Sum::None, Trouble::None, rate<&Rates::meanHz>,
              "Samples per second from the first to the last of the range"},
    FigureRow{RateLeast, "", "Hz min.", kHzShort, Sum::None, Trouble::None, rate<&Rates::leastHz>,
              "Fewest samples per second in any part of the range of a second or more"},
    FigureRow{RateMost, "", "Hz max.", kHzShort, Sum::None, Trouble::None, rate<&Rates::mostHz>,
              "Most samples per second in any part of the range of a second or more"},
    FigureRow{RateDeviation, "", "Hz dev.", kHzLong, Sum::None, Trouble::None, rate<&Rates::deviationHz>,
              "Standard deviation of the samples per second in parts of the range"},
    FigureRow{DatagramRate, "", "Datagr./s", kPerSecond, Sum::Sum, Trouble::None,
              rate<&Rates::datagramsPerSecond>,
              "Well-formed datagrams per second from the first to the last of the range", Of::Messages},
    FigureRow{Bandwidth, "", "kB/s", kKilobytes, Sum::Sum, Trouble::None, kilobytes,
              "Thousands of payload bytes of UDP or TCP per second", Of::Messages},
};
// Each once, in the order of the enum.
static_assert(kRows.size() == kFigures);
static_assert(std::ranges::adjacent_find(kRows, std::ranges::greater_equal(), &FigureRow::figure) ==
              kRows.end());

constexpr std::size_t kMostSpans = 120;

/// The part of the range in which the stream was on the air, as the history rounds it.
TimeRange onAir(const StreamAccounting& stream, const std::optional<TimeRange>& range) {
    TimeRange air{stream.firstStamp(), stream.lastStamp()};
    if (range) {
        air.from = std::max(air.from, stream.history().roundedUp(range->from));
        air.to = std::min(air.to, stream.history().roundedUp(range->to));
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
    const bool isSampled = stream.isSampled();
    const auto whole = static_cast<double>(isSampled ? counts.samples : counts.datagrams);
    const double units = whole + (isSampled ? static_cast<double>(counts.incomplete) : 0);
    if (seconds <= 0 || units <= 1) {
        return;
    }
    // Messages come seldom and in several datagrams at once: a moment is no measure of how often.
    rate.meanHz = whole > 1 && seconds > (isSampled ? 0 : 1) ? (whole - cut) / seconds : 0;
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

std::span<const FigureRow, kFigures> figureTable() {
    return kRows;
}

const FigureRow& rowOf(Figure figure) {
    return kRows[static_cast<std::size_t>(figure)];
}

StreamFigures::StreamFigures() : m_isSum(true) {
    for (const FigureRow& row : kRows) {
        set(row.figure, row.sum == FigureSum::Sum ? 0 : kUnknown);
    }
}

StreamFigures::StreamFigures(const log::StreamKey& key, const RangeFigures& read)
    : m_key(key), m_isSampled(countsSamples(key.type)) {
    for (const FigureRow& row : kRows) {
        set(row.figure, row.read(read));
    }
}

double StreamFigures::orZero(Figure figure) const {
    const double value = (*this)[figure];
    return std::isnan(value) ? 0 : value;
}

bool StreamFigures::has(Figure figure) const {
    const FigureRow& row = rowOf(figure);
    return (m_isSampled || row.scope != FigureScope::Samples) && (!m_isSum || row.sum != FigureSum::None);
}

FigureTrouble StreamFigures::trouble(Figure figure) const {
    // Where the step is irregular there are gaps, but nothing is lost.
    const bool isTrouble = (*this)[figure] > 0 && (figure != LongestGap || (*this)[Lost] > 0);
    return isTrouble ? rowOf(figure).trouble : FigureTrouble::None;
}

bool StreamFigures::isFromTimeCode() const {
    return !std::isnan((*this)[Skew]);
}

double StreamFigures::expected() const {
    return (*this)[Samples] + (*this)[Missing];
}

void StreamFigures::add(const StreamFigures& other) {
    const double own = expected();
    const double all = own + other.expected();
    for (const FigureRow& row : kRows) {
        if (!other.m_isSampled && row.scope != FigureScope::Messages) {
            continue; // a message of which only a part came is no sample
        }
        const double before = (*this)[row.figure];
        const double more = other[row.figure];
        switch (row.sum) {
        case FigureSum::None:
            break;
        case FigureSum::Sum:
            set(row.figure, before + more);
            break;
        case FigureSum::Most:
            set(row.figure, std::fmax(before, more));
            break;
        case FigureSum::Mean:
            set(row.figure, all > 0 ? (orZero(row.figure) * own + more * other.expected()) / all : 0);
            break;
        }
    }
    m_isSampled = m_isSampled || other.m_isSampled;
}

StreamFigures figuresOf(const Stream& stream, const std::optional<TimeRange>& range) {
    RangeFigures read = figuresOf(stream.accounting, range);
    read.rate.nowHz = range ? read.rate.meanHz : stream.statistics.rateHz();
    if (range) {
        read.lostByCause[static_cast<std::size_t>(LossCause::Unknown)] =
            read.counts.lost + read.counts.incomplete;
    } else {
        read.lostByCause = stream.lostByCause();
    }
    StreamFigures figures(stream.key, read);
    if (range) { // counters are kept of all there is
        figures.set(FirstSample, std::numeric_limits<double>::quiet_NaN());
        figures.set(LastSample, std::numeric_limits<double>::quiet_NaN());
    }
    return figures;
}

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
