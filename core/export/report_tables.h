// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/report_series.h"
#include "core/log/time.h"

#include <string>

namespace posewire::exporting {

/// Every figure of the streams of one character; sparklines of rate and loss beside them.
[[nodiscard]] std::string streamTable(const model::SessionView& session, const model::CharacterKey& key,
                                      const std::vector<model::StreamFigures>& figures,
                                      const ReportSteps& steps);

/// The metadata of a character; empty where it sent none.
[[nodiscard]] std::string metadataList(const model::SessionView& session, const model::CharacterKey& key);

/// "2026-11-21 16:01:32.123 UTC".
[[nodiscard]] std::string utcText(log::Stamp stamp);

} // namespace posewire::exporting
