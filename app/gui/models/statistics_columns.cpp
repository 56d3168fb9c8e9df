// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/statistics_columns.h"

#include "app/gui/models/text.h"

#include <algorithm>
#include <array>

namespace posewire::gui {

namespace {

using Column = StatisticsColumn;

constexpr std::size_t kCount = kStatisticsColumns;

constexpr std::array<ColumnText, kCount> kTexts{{
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Stream"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Source, character and message type; sources and characters are the sums of their "
                       "streams"),
     false},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Hz"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Samples a second by arrival at this computer: over the newest 2 s, or the mean of "
                       "the range")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Jitter ms"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Interarrival jitter at the end of the range (RFC 3550 section 6.4.1); of a "
                       "sum, that of its worst stream")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Lost"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Samples that should have come, by the sender's own step, and of which nothing "
                       "came. Double click: the packets after each gap")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Reord."),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "First arrivals below the highest sample counter so far (RFC 4737 section 3)")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Curve"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Rate over the range, or over the last two minutes; marked where samples were "
                       "lost")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Lost %"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Share of the samples expected of which nothing or not all came")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Dupl."),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Datagrams whose sample and datagram counter came before")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Late"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Reordered by more than the display waits, 50 ms (RFC 4737 section 4.3)")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Incompl."),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Samples or messages of which some but not all datagrams came")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Restarts"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "How often the sender's counter began anew (RFC 3550 appendix A.1)")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Malformed"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Datagrams that begin with MXTP and cannot be decoded")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "kB/s"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Thousands of payload bytes of UDP or TCP a second")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Longest gap"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Most samples lost in a row")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Spacing max."),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Most time between the first arrivals of successive samples, ms")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Spacing dev."),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Standard deviation of the time between first arrivals of successive samples, ms")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Spacing mean"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Mean time between the first arrivals of successive samples, ms")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Spacing min."),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Least time between the first arrivals of successive samples, ms")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Hz mean"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Samples a second from the first to the last of the range")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Hz min."),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Least samples a second in any part of the range, of a second or more")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Hz max."),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Most samples a second in any part of the range, of a second or more")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Hz dev."),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Standard deviation of the samples a second in parts of the range")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Bursts"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Times in which losses were less than 16 samples apart (RFC 3611 section "
                       "4.7.2), by when they ended")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Burst length"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Mean samples from the first to the last loss of a burst (RFC 3611 "
                       "section 4.7.2)")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Burst dens. %"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Share of the samples in bursts that were lost (RFC 3611 section "
                       "4.7.2)")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Gap dens. %"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Share of the samples between bursts that were lost (RFC 3611 section "
                       "4.7.2)")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Skew ppm"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "How much faster the sender's clock goes than this computer's; only where "
                       "the header's time code advances")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Drift ms"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "What the skew made of the sender's clock in the range")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Samples"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Sample counters of which all datagrams came")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Datagrams"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Well-formed datagrams, duplicates included")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Datagr./s"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Well-formed datagrams a second from the first to the last of the range")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Step"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "The sender's own spacing of sample counters; 0 where it is irregular, so that "
                       "nothing can be counted as lost")},
}};

QString counted(std::uint64_t count) {
    return grouped(count);
}

QString spacingText(const model::InterArrival& arrivals, double value, int decimals) {
    return arrivals.count == 0 ? QStringLiteral("–") : fixed(value, decimals);
}

QString patternText(const StatisticsFigures& figures, Column column) {
    const model::LossPattern& pattern = figures.range.pattern;
    switch (column) {
    case Column::Bursts:
        return counted(pattern.bursts);
    case Column::BurstLength:
        return fixed(pattern.meanBurstSamples, 1);
    case Column::BurstDensity:
        return fixed(pattern.burstDensity * 100, 2);
    default:
        return fixed(pattern.gapDensity * 100, 3);
    }
}

/// What a sum has too.
QString countText(const StatisticsFigures& figures, Column column) {
    const model::StreamCounts& counts = figures.range.counts;
    switch (column) {
    case Column::Lost:
        return counted(counts.lost);
    case Column::LossShare:
        return fixed(counts.lossRatio() * 100, 2);
    case Column::Reordered:
        return counted(counts.reordered);
    case Column::Duplicates:
        return counted(counts.duplicates);
    case Column::Late:
        return counted(counts.late);
    case Column::Incomplete:
        return counted(counts.incomplete);
    case Column::Restarts:
        return counted(counts.restarts);
    case Column::LongestGap:
        return counted(counts.longestGapSamples);
    case Column::Samples:
        return counted(counts.samples);
    default:
        return {};
    }
}

QString flowText(const StatisticsFigures& figures, Column column) {
    const model::RangeFigures& range = figures.range;
    switch (column) {
    case Column::Datagrams:
        return counted(range.counts.datagrams);
    case Column::DatagramRate:
        return fixed(range.rate.datagramsPerSecond, 1);
    case Column::Bandwidth:
        return fixed(range.rate.bytesPerSecond / 1000, 1);
    case Column::Malformed:
        return counted(range.malformed);
    default:
        return {};
    }
}

QString clockText(const model::ClockFigures& clock, Column column) {
    const bool isSkew = column == Column::Skew || column == Column::Drift;
    if (isSkew && !clock.isFromTimeCode) {
        return QStringLiteral("–");
    }
    switch (column) {
    case Column::Skew:
        return signedFixed(clock.skewPpm, 1);
    case Column::Drift:
        return signedFixed(clock.driftMs, 2);
    default:
        return fixed(clock.jitterMs, 2);
    }
}

QString rateText(const StatisticsFigures& figures, Column column) {
    const model::RateFigures& rate = figures.range.rate;
    switch (column) {
    case Column::Rate:
        return fixed(figures.rateHz, 1);
    case Column::RateMean:
        return fixed(rate.meanHz, 2);
    case Column::RateLeast:
        return fixed(rate.leastHz, 1);
    case Column::RateMost:
        return fixed(rate.mostHz, 1);
    default:
        return fixed(rate.deviationHz, 2);
    }
}

QString arrivalText(const model::InterArrival& arrivals, Column column) {
    switch (column) {
    case Column::SpacingMost:
        return spacingText(arrivals, arrivals.mostMs, 2);
    case Column::SpacingDeviation:
        return spacingText(arrivals, arrivals.deviationMs, 2);
    case Column::SpacingMean:
        return spacingText(arrivals, arrivals.meanMs, 3);
    default:
        return spacingText(arrivals, arrivals.leastMs, 2);
    }
}

std::uint64_t troubleOf(const StatisticsFigures& figures, Column column) {
    const model::StreamCounts& counts = figures.range.counts;
    switch (column) {
    case Column::Lost:
    case Column::LossShare:
    case Column::LongestGap:
        return counts.lost + (column == Column::LossShare ? counts.incomplete : 0);
    case Column::Late:
        return counts.late;
    case Column::Incomplete:
        return counts.incomplete;
    case Column::Restarts:
        return counts.restarts;
    case Column::Malformed:
        return figures.range.malformed;
    case Column::Bursts:
        return figures.range.pattern.bursts;
    default:
        return 0;
    }
}

} // namespace

void StatisticsFigures::add(const StatisticsFigures& other) {
    range.counts += other.range.counts;
    range.rate.datagramsPerSecond += other.range.rate.datagramsPerSecond;
    range.rate.bytesPerSecond += other.range.rate.bytesPerSecond;
    range.clock.jitterMs = std::max(range.clock.jitterMs, other.range.clock.jitterMs);
    range.arrivals.mostMs = std::max(range.arrivals.mostMs, other.range.arrivals.mostMs);
    range.arrivals.count += other.range.arrivals.count;
    isSampled = isSampled || other.isSampled;
    range.malformed += other.range.malformed;
    range.pattern.bursts += other.range.pattern.bursts;
}

std::span<const ColumnText> statisticsColumns() {
    return kTexts;
}

QString statisticsSample(StatisticsColumn column) {
    switch (column) {
    case Column::Stream:
        return {};
    case Column::Rate:
        return QStringLiteral("9999.9");
    case Column::Jitter:
        return QStringLiteral("999.99");
    case Column::Lost:
        return QStringLiteral("▲ 9999");
    case Column::Reordered:
        return QStringLiteral("99999");
    case Column::Curve:
        return QStringLiteral("0000000");
    case Column::LossShare:
        return QStringLiteral("▲ 99.99");
    case Column::Samples:
    case Column::Datagrams:
        return QStringLiteral("99 999 999");
    case Column::Malformed:
        return QStringLiteral("■ 9999");
    case Column::Step:
        return QStringLiteral("99");
    default:
        return QStringLiteral("9999.99");
    }
}

QString statisticsText(const StatisticsFigures& figures, StatisticsColumn column) {
    const model::RangeFigures& range = figures.range;
    if (const QString text = flowText(figures, column); !text.isEmpty()) {
        return text;
    }
    const bool isMessage = !figures.isSampled && column != Column::Incomplete && column != Column::Rate;
    if (isMessage) {
        return {};
    }
    if (const QString text = countText(figures, column); !text.isEmpty()) {
        return text;
    }
    switch (column) {
    case Column::Jitter:
        return clockText(range.clock, column);
    case Column::SpacingMost:
        return arrivalText(range.arrivals, column);
    case Column::Bursts:
        return patternText(figures, column);
    default:
        break;
    }
    if (figures.isSum) {
        return {};
    }
    switch (column) {
    case Column::Rate:
    case Column::RateMean:
    case Column::RateLeast:
    case Column::RateMost:
    case Column::RateDeviation:
        return rateText(figures, column);
    case Column::SpacingDeviation:
    case Column::SpacingMean:
    case Column::SpacingLeast:
        return arrivalText(range.arrivals, column);
    case Column::BurstLength:
    case Column::BurstDensity:
    case Column::GapDensity:
        return patternText(figures, column);
    case Column::Skew:
    case Column::Drift:
        return clockText(range.clock, column);
    case Column::Step:
        return counted(range.counts.step);
    default:
        return {};
    }
}

Health statisticsHealth(const StatisticsFigures& figures, StatisticsColumn column) {
    if (troubleOf(figures, column) == 0) {
        return Health::Unknown;
    }
    return column == Column::Malformed ? Health::Error : Health::Warning;
}

bool isQuiet(const StatisticsFigures& figures, StatisticsColumn column) {
    const model::StreamCounts& counts = figures.range.counts;
    switch (column) {
    case Column::Reordered:
        return counts.reordered == 0;
    case Column::Duplicates:
        return counts.duplicates == 0;
    case Column::Lost:
    case Column::LossShare:
    case Column::LongestGap:
    case Column::Late:
    case Column::Incomplete:
    case Column::Restarts:
    case Column::Malformed:
    case Column::Bursts:
        return troubleOf(figures, column) == 0;
    default:
        return false;
    }
}

} // namespace posewire::gui
