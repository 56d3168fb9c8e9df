// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/report_series.h"

#include <string>

namespace posewire::exporting {

/// Samples lost over time, in a colour for each cause.
[[nodiscard]] SvgPlot causePlot(const model::SessionView& session, const ReportSteps& steps);

/// The longest gaps of the range with cause and evidence, in the order of time; empty where there are none.
[[nodiscard]] std::string gapSection(const model::SessionView& session, const ReportSteps& steps);

} // namespace posewire::exporting
