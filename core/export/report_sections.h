// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/incidents/incident.h"
#include "core/model/session/session_view.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The sections of a stream report, as HTML.
namespace posewire::exporting {

/// The time that a report shows, cut into equal steps that buckets of the accounting fill exactly.
struct ReportSteps {
    log::Stamp from{}; ///< where the report begins: the first stamp, or what was asked for
    log::Stamp to{};
    log::Stamp first{}; ///< where the first step begins, at or before from
    log::Duration width{1};
    std::size_t count = 0;

    [[nodiscard]] double durationS() const { return log::secondsOf(to - from); }
};

/// All streams of the session together, within the range.
[[nodiscard]] ReportSteps stepsOf(const model::SessionView& session,
                                  const std::optional<model::TimeRange>& range);

/// "good", "warning", "error": shown by shape, colour and words.
[[nodiscard]] std::string_view severityName(model::IncidentSeverity severity);
/// ● ▲ ■
[[nodiscard]] std::string_view severityMark(model::IncidentSeverity severity);

/// Rate, loss and jitter of each character and the losses by cause, over time; empty where there is too
/// little.
[[nodiscard]] std::string plotSection(const model::SessionView& session, const ReportSteps& steps);

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
