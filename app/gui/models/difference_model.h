// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/comparison.h"
#include "app/gui/models/column.h"

#include <optional>

namespace posewire::gui {

struct DifferenceRow {
    int slot = 0;                                  ///< see model::kAllSegments
    std::optional<model::SegmentDifference> now{}; ///< nothing if there is no partner
    std::optional<exporting::SegmentFigures> range{};
    QColor colour{}; ///< as in the viewport; none without a partner
};

/// All segments that both bodies have, at the moment that is shown and over the range; in the order that the
/// operator chose, the worst first.
class DifferenceModel : public TableModel<DifferenceRow> {
public:
    enum Column : int {
        kName,
        kNow,
        kMean,
        kMost,
        kNowTurn,
        kMeanTurn,
        kMostTurn,
        kMedian,
        kP95,
        kMedianTurn,
        kP95Turn,
    };

    DifferenceModel() : TableModel(columns()) {}

    void refresh(const ComparisonState& state);
    void sort(int column, Qt::SortOrder direction) override;

    /// -1 if there is none.
    [[nodiscard]] int rowOf(int slot) const;

private:
    [[nodiscard]] static std::vector<TableColumn<DifferenceRow>> columns();
    void order(std::vector<DifferenceRow>& rows) const;

    int m_column = kMean;
    Qt::SortOrder m_order = Qt::DescendingOrder;
};

/// "Left Hand".
[[nodiscard]] QString segmentOfSlot(int slot);

} // namespace posewire::gui
