// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/stream_report.h"
#include "core/model/accounting/stream_figures.h"

namespace posewire::exporting {

/// Shown by shape, colour and words.
enum class ReportSeverity : std::uint8_t { Good, Warning, Error };

struct Finding {
    ReportSeverity severity = ReportSeverity::Good;
    std::string text; ///< one sentence, not escaped
};

/// "good", "warning", "error".
[[nodiscard]] std::string_view severityName(ReportSeverity severity);
/// ● ▲ ■
[[nodiscard]] std::string_view severityMark(ReportSeverity severity);

/// What all figures together mean: the first sums it up, the others say why.
[[nodiscard]] std::vector<Finding> verdictOn(const model::SessionView& session,
                                             const std::vector<model::StreamFigures>& streams,
                                             const StreamReportOptions& options);

} // namespace posewire::exporting
