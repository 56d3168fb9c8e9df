// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/difference_model.h"

#include "app/gui/models/comparison_text.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace posewire::gui {
namespace {

using Row = DifferenceRow;
using DifferenceColumn = TableColumn<Row>;
using exporting::DifferenceFigures;

using exporting::SegmentFigures;

struct RangeColumn {
    int column;
    DifferenceFigures SegmentFigures::*of;
    double DifferenceFigures::*value;
};

constexpr RangeColumn kRangeColumns[] = {
    {DifferenceModel::kMean, &SegmentFigures::millimetres, &DifferenceFigures::mean},
    {DifferenceModel::kMost, &SegmentFigures::millimetres, &DifferenceFigures::most},
    {DifferenceModel::kMedian, &SegmentFigures::millimetres, &DifferenceFigures::median},
    {DifferenceModel::kP95, &SegmentFigures::millimetres, &DifferenceFigures::p95},
    {DifferenceModel::kMeanTurn, &SegmentFigures::degrees, &DifferenceFigures::mean},
    {DifferenceModel::kMostTurn, &SegmentFigures::degrees, &DifferenceFigures::most},
    {DifferenceModel::kMedianTurn, &SegmentFigures::degrees, &DifferenceFigures::median},
    {DifferenceModel::kP95Turn, &SegmentFigures::degrees, &DifferenceFigures::p95}};

/// NaN for nothing.
double valueIn(const Row& row, int column) {
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    const auto* found = std::ranges::find(kRangeColumns, column, &RangeColumn::column);
    if (found != std::end(kRangeColumns)) {
        return row.range ? *row.range.*found->of.*found->value : kNothing;
    }
    const bool isNow = row.now && column != DifferenceModel::kName;
    return !isNow ? kNothing : column == DifferenceModel::kNow ? row.now->millimetres : row.now->degrees;
}

constexpr int kDistanceDecimals = 1; // of mm
constexpr int kTurnDecimals = 2;     // of degrees

DifferenceColumn numbers(const QString& title, const QString& help, int column, int decimals,
                         int order = ColumnRoom::kOnChoice) {
    return DifferenceColumn::numbers(
               title, help,
               [column, decimals](const Row& row) { return fixed(valueIn(row, column), decimals); })
        .in({.usual = QStringLiteral("9999.9"), .order = order});
}

} // namespace

QString segmentOfSlot(int slot) {
    return fromUtf8(model::segmentTitle(model::kAllSegments, slot));
}

std::vector<DifferenceColumn> DifferenceModel::columns() {
    auto name = DifferenceColumn::words(
        tr("Segment"), tr("Segments that both bodies have; the colour is that in the viewport"),
        [](const Row& row) { return segmentOfSlot(row.slot); });
    name.room = {.usual = QStringLiteral("■ Right Upper Arm"), .isOpen = true};
    name.more = [](const Row& row, int role) {
        return role == kSwatchRole && row.colour.isValid() ? QVariant(row.colour) : QVariant();
    };
    return withHelpInCells(std::vector<DifferenceColumn>{
        std::move(name),
        numbers(tr("Shown mm"), tr("Between the origins of the segment, at the moment that is shown"), kNow,
                kDistanceDecimals, 0),
        numbers(tr("Mean mm"), tr("Mean distance of the origins over the range"), kMean, kDistanceDecimals,
                0),
        numbers(tr("Worst mm"), tr("Largest distance of the origins in the range"), kMost, kDistanceDecimals,
                4),
        numbers(tr("Shown °"), tr("Turn from one orientation to the other, at the moment that is shown"),
                kNowTurn, kTurnDecimals, 3),
        numbers(tr("Mean °"), tr("Mean turn over the range"), kMeanTurn, kTurnDecimals, 2),
        numbers(tr("Worst °"), tr("Largest turn in the range"), kMostTurn, kTurnDecimals, 1),
        numbers(tr("Median mm"), tr("Half of the distances in the range are below"), kMedian,
                kDistanceDecimals),
        numbers(tr("95 % mm"), tr("95 of 100 distances in the range are below"), kP95, kDistanceDecimals),
        numbers(tr("Median °"), tr("Half of the turns in the range are below"), kMedianTurn, kTurnDecimals),
        numbers(tr("95 % °"), tr("95 of 100 turns in the range are below"), kP95Turn, kTurnDecimals),
    });
}

void DifferenceModel::refresh(const ComparisonState& state) {
    std::array<Row, model::kMaxSegmentCount> bySlot{};
    const DifferenceScale scale = scaleOf(state);
    if (state.atCursor) {
        for (const model::SegmentDifference& one : state.atCursor->segments) {
            Row& row = bySlot[static_cast<std::size_t>(one.slot)];
            row.now = one;
            row.colour = scale.colourOf(one.millimetres);
        }
    }
    if (state.range != nullptr) {
        for (const exporting::SegmentFigures& one : state.range->segments) {
            bySlot[static_cast<std::size_t>(one.slot)].range = one;
        }
    }
    std::vector<Row> rows;
    for (std::size_t slot = 0; slot < bySlot.size(); ++slot) {
        if (bySlot[slot].now || bySlot[slot].range) {
            rows.push_back(bySlot[slot]);
            rows.back().slot = static_cast<int>(slot);
        }
    }
    order(rows);
    setRows(std::move(rows));
}

/// Segments without a value come last, whatever the order.
void DifferenceModel::order(std::vector<Row>& rows) const {
    if (m_column == kName) {
        if (m_order == Qt::DescendingOrder) {
            std::ranges::reverse(rows);
        }
        return;
    }
    std::ranges::stable_sort(rows, {}, [this](const Row& row) {
        const double value = valueIn(row, m_column);
        const double key = m_order == Qt::DescendingOrder ? -value : value;
        return std::isnan(value) ? std::numeric_limits<double>::infinity() : key;
    });
}

void DifferenceModel::sort(int column, Qt::SortOrder direction) {
    m_column = column;
    m_order = direction;
    std::vector<Row> sorted = rows();
    std::ranges::sort(sorted, {}, &Row::slot);
    order(sorted);
    setRows(std::move(sorted));
}

int DifferenceModel::rowOf(int slot) const {
    const auto found = std::ranges::find(rows(), slot, &Row::slot);
    return found == rows().end() ? -1 : static_cast<int>(found - rows().begin());
}

} // namespace posewire::gui
