// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/columns.h"
#include "app/gui/theme/theme.h"
#include "core/model/accounting/range_figures.h"

#include <QString>

#include <optional>
#include <span>

namespace posewire::gui {

/// What there is to know about streams. The first are always shown, the others as they fit or are chosen.
enum class StatisticsColumn : int {
    Stream,
    Rate,
    Jitter,
    Lost,
    Reordered,
    Curve,
    LossShare,
    Duplicates,
    Late,
    Incomplete,
    Restarts,
    Malformed,
    Bandwidth,
    LongestGap,
    SpacingMost,
    SpacingDeviation,
    SpacingMean,
    SpacingLeast,
    RateMean,
    RateLeast,
    RateMost,
    RateDeviation,
    Bursts,
    BurstLength,
    BurstDensity,
    GapDensity,
    Skew,
    Drift,
    Samples,
    Datagrams,
    DatagramRate,
    Step,
    Count
};
inline constexpr int kStatisticsColumns = static_cast<int>(StatisticsColumn::Count);
/// Those before it are shown however narrow the dock is.
inline constexpr StatisticsColumn kFirstOptionalStatistic = StatisticsColumn::Curve;

/// The figures of a row: of one stream, or a sum.
struct StatisticsFigures {
    bool isSum = false;
    bool isSampled = true; ///< false: only datagrams and what is incomplete can be counted
    model::RangeFigures range;
    double rateHz = 0; ///< as it is now, or, in a range, its mean

    /// Adds counts and rates; of the others the worst is kept.
    void add(const StatisticsFigures& other);
};

/// Titles and explanations, in the order of the columns; the context of translation is kStatisticsContext.
[[nodiscard]] std::span<const ColumnText> statisticsColumns();
inline constexpr const char* kStatisticsContext = "posewire::gui::StatisticsModel";

/// As long as the content of a column may become.
[[nodiscard]] QString statisticsSample(StatisticsColumn column);

/// A figure as it is shown, without a symbol; empty where the row has none of that kind.
[[nodiscard]] QString statisticsText(const StatisticsFigures& figures, StatisticsColumn column);

/// Whether a figure is one to look at. Unknown for all that is neither good nor bad.
[[nodiscard]] Health statisticsHealth(const StatisticsFigures& figures, StatisticsColumn column);

/// True of a count that is zero: nothing to look at.
[[nodiscard]] bool isQuiet(const StatisticsFigures& figures, StatisticsColumn column);

} // namespace posewire::gui
