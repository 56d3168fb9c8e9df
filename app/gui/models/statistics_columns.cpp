// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/statistics_columns.h"

#include "app/gui/models/columns.h"
#include "app/gui/models/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace posewire::gui {

namespace {

using enum model::Figure;

struct Column {
    std::optional<model::Figure> figure;
    const char* sample = "9999.99"; ///< as wide as its content may become
};

// Settings know columns by their place: new ones belong at the end.
constexpr std::array<Column, kStatisticsColumns> kColumns{{
    {std::nullopt, ""},
    {Rate, "9999.9"},
    {Jitter, "999.99"},
    {Lost, "▲ 9999"},
    {Reordered, "99999"},
    {std::nullopt, "0000000"},
    {LossShare, "▲ 99.99"},
    {Duplicates},
    {Late},
    {Incomplete},
    {Restarts},
    {Malformed, "■ 9999"},
    {Bandwidth},
    {LongestGap},
    {SpacingMost},
    {SpacingDeviation},
    {SpacingMean},
    {SpacingLeast},
    {RateMean},
    {RateLeast},
    {RateMost},
    {RateDeviation},
    {Bursts},
    {BurstLength},
    {BurstDensity},
    {GapDensity},
    {Skew},
    {Drift},
    {Samples, "99 999 999"},
    {Datagrams, "99 999 999"},
    {DatagramRate},
    {Step, "99"},
}};

constexpr ColumnText kName{QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Stream"),
                           QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                                             "Source, character and message type; sources and characters "
                                             "are the sums of their streams"),
                           false};
constexpr ColumnText kCurve{
    QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Curve"),
    QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                      "Rate over the range, or over the last two minutes; marked where samples were lost")};

QString tr(const char* text) {
    return QCoreApplication::translate("posewire::gui::StatisticsModel", text);
}

} // namespace

std::optional<model::Figure> figureIn(int column) {
    return kColumns[static_cast<std::size_t>(column)].figure;
}

int columnOf(model::Figure figure) {
    const auto* found = std::ranges::find(kColumns, std::optional(figure), &Column::figure);
    return found == kColumns.end() ? -1 : static_cast<int>(found - kColumns.begin());
}

QVariant statisticsHeader(int column, int role) {
    if (column < 0 || column >= kStatisticsColumns) {
        return {};
    }
    const auto figure = figureIn(column);
    if (!figure) {
        return columnHeader({column == kNameColumn ? &kName : &kCurve, 1}, "posewire::gui::StatisticsModel",
                            0, role);
    }
    const model::FigureRow& row = model::rowOf(*figure);
    switch (role) {
    case Qt::DisplayRole:
        return tr(row.shortTitle());
    case Qt::ToolTipRole:
        return row.packets == nullptr
                   ? tr(row.help)
                   : QStringLiteral("%1. %2").arg(tr(row.help),
                                                  tr("Double click: %1").arg(tr(row.packets).toLower()));
    case Qt::TextAlignmentRole:
        return numberAlignment();
    default:
        return {};
    }
}

QString statisticsSample(int column) {
    return QString::fromUtf8(kColumns[static_cast<std::size_t>(column)].sample);
}

QString statisticsText(const model::StreamFigures& figures, model::Figure figure) {
    const model::FigureRow& row = model::rowOf(figure);
    const double value = figures[figure];
    if (!figures.has(figure)) {
        return {};
    }
    switch (row.style.form) {
    case model::FigureForm::Count:
    case model::FigureForm::Counter:
        return grouped(figures.count(figure));
    case model::FigureForm::Share:
        return fixed(100 * value, row.style.digits.window);
    case model::FigureForm::Signed:
        return signedFixed(value, row.style.digits.window);
    case model::FigureForm::Number:
        break;
    }
    return fixed(value, row.style.digits.window);
}

QString statisticsNumber(const model::StreamFigures& figures, model::Figure figure) {
    const model::FigureRow& row = model::rowOf(figure);
    const double value = (row.style.form == model::FigureForm::Share ? 100 : 1) * figures[figure];
    if (!figures.has(figure) || !std::isfinite(value)) {
        return {};
    }
    const bool isZero = std::abs(value) * std::pow(10, row.style.digits.window) < 0.5; // which has no sign
    return QString::number(isZero ? 0 : value, 'f', row.style.digits.window);
}

Health statisticsHealth(const model::StreamFigures& figures, model::Figure figure) {
    switch (figures.trouble(figure)) {
    case model::FigureTrouble::Warning:
        return Health::Warning;
    case model::FigureTrouble::Error:
        return Health::Error;
    case model::FigureTrouble::None:
    case model::FigureTrouble::Odd:
        break;
    }
    return Health::Unknown;
}

bool isQuiet(const model::StreamFigures& figures, model::Figure figure) {
    return model::rowOf(figure).trouble != model::FigureTrouble::None &&
           figures.trouble(figure) == model::FigureTrouble::None;
}

} // namespace posewire::gui
