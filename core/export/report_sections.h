// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/report_series.h"

#include <string>
#include <string_view>

/// The sections of a stream report, as HTML.
namespace posewire::exporting {

/// "good", "warning", "error": shown by shape, colour and words.
[[nodiscard]] std::string_view severityName(model::EventSeverity severity);
/// ● ▲ ■
[[nodiscard]] std::string_view severityMark(model::EventSeverity severity);

/// Every figure of the streams of one character; sparklines of rate and loss beside them.
[[nodiscard]] std::string streamTable(const model::SessionView& session, const model::CharacterKey& key,
                                      const std::vector<model::StreamFigures>& figures,
                                      const ReportSteps& steps);

/// The metadata of a character; empty where it sent none.
[[nodiscard]] std::string metadataList(const model::SessionView& session, const model::CharacterKey& key);

/// The longest gaps of the range with cause and evidence, in the order of time; empty where there are none.
[[nodiscard]] std::string gapSection(const model::SessionView& session, const ReportSteps& steps);

/// What happened in the time of the report, in its order; the newest where there was very much. Empty where
/// nothing did.
[[nodiscard]] std::string eventSection(const model::SessionView& session, const ReportSteps& steps);

} // namespace posewire::exporting
