// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/report_series.h"

#include <string>

namespace posewire::exporting {

/// What happened in the time of the report, in its order; the newest where there was very much. Empty where
/// nothing did.
[[nodiscard]] std::string eventSection(const model::SessionView& session, const ReportSteps& steps);

} // namespace posewire::exporting
