// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/statistics_model.h"

namespace posewire::gui {

/// A display filter for packets of a time, such as `time >= 12.3 && time < 14.5`.
[[nodiscard]] QString rangeFilter(model::SessionView& view, const model::TimeRange& range);

/// A display filter for the packets that a cell counts: those of the row, in the range of the figures; in
/// columns of what went wrong, those at which it did.
[[nodiscard]] QString statisticsFilter(model::SessionView& view, const StatisticsModel& model,
                                       const QModelIndex& index);

/// What the packets of such a filter are, in the words of a menu: "Packets after a gap"; empty for columns
/// that count nothing that packets could show.
[[nodiscard]] QString statisticsFilterTitle(int column);

} // namespace posewire::gui
