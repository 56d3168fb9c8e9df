// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"
#include "core/model/accounting/stream_figures.h"

#include <QString>
#include <QVariant>

#include <optional>

/// The columns of the statistics: the name of a row, then figures, and among them the curve of the rate. The
/// first are always shown, the others as they fit or are chosen.
namespace posewire::gui {

inline constexpr int kStatisticsColumns = 32;
inline constexpr int kNameColumn = 0;
inline constexpr int kCurveColumn = 5;
/// Those before it are shown however narrow the dock is.
inline constexpr int kFirstOptionalStatistic = kCurveColumn;

/// The figure of a column; nothing for the name and the curve.
[[nodiscard]] std::optional<model::Figure> figureIn(int column);
/// -1 for figures that are not shown.
[[nodiscard]] int columnOf(model::Figure figure);

[[nodiscard]] QVariant statisticsHeader(int column, int role);

/// As long as the content of a column may become.
[[nodiscard]] QString statisticsSample(int column);

/// A figure as it is shown, without a symbol; empty where the row has none of that kind.
[[nodiscard]] QString statisticsText(const model::StreamFigures& figures, model::Figure figure);
/// The same number as programs read it; empty also where it is not known.
[[nodiscard]] QString statisticsNumber(const model::StreamFigures& figures, model::Figure figure);

/// Whether a figure is one to look at. Unknown for all that is neither good nor bad.
[[nodiscard]] Health statisticsHealth(const model::StreamFigures& figures, model::Figure figure);

/// True of a count of trouble that is zero: nothing to look at.
[[nodiscard]] bool isQuiet(const model::StreamFigures& figures, model::Figure figure);

} // namespace posewire::gui
