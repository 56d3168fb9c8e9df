// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/comparison/pose_comparison.h"
#include "core/log/output_file.h"

#include <span>
#include <string>

namespace posewire::exporting {

/// Writes a table (RFC 4180, UTF-8, lines end with CR LF) with a row for each sample of the first recording
/// and the columns
///
///     time,sample,timeCode,otherSample,otherTimeCode,Pelvis mm,Pelvis degrees,L5 mm,…
///
/// time is seconds since the first row; counters and time codes (ms) are as sent. Cells of what has no
/// partner are empty. The file is there whole or not at all.
[[nodiscard]] tl::expected<void, log::FileError>
writeComparisonCsv(const ComparisonTask& task, std::span<const SegmentFigures> segments,
                   const std::string& path, const log::OutputRules& rules, const ExportProgress& progress);

} // namespace posewire::exporting
