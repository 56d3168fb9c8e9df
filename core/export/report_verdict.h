// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/stream_report.h"

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

/// What all figures together mean: the first says it all, the others why.
[[nodiscard]] std::vector<Finding> verdictOn(const model::SessionView& session,
                                             const std::vector<StreamFigures>& streams,
                                             const StreamReportOptions& options);

} // namespace posewire::exporting
