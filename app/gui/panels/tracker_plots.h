// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/tracker_model.h"
#include "app/gui/plots/time_plot.h"

namespace posewire::gui {

/// The last ten seconds of a tracker before the cursor: free acceleration x y z above, norm of the magnetic
/// field below.
[[nodiscard]] TimePlot* makeTrackerPlot(QWidget* parent);

void plotHistory(TimePlot& plot, const TrackerHistory& history);

} // namespace posewire::gui
