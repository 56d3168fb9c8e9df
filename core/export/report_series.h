// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/session_reading.h"
#include "core/export/svg_plot.h"

namespace posewire::exporting {

/// The time that a report shows, cut into equal steps that buckets of the accounting fill exactly.
struct ReportSteps {
    std::int64_t fromNs = 0; ///< where the report begins: the first stamp, or what was asked for
    std::int64_t toNs = 0;
    std::int64_t firstNs = 0; ///< where the first step begins, at or before fromNs
    std::int64_t widthNs = 1;
    std::size_t count = 0;

    [[nodiscard]] double durationS() const { return static_cast<double>(toNs - fromNs) * 1e-9; }
};

/// All streams of the session together, within the range.
[[nodiscard]] ReportSteps stepsOf(const model::SessionView& session,
                                  const std::optional<model::TimeRange>& range);

/// Rate, loss and jitter over time; a curve for each character, of its fastest, all and its worst stream.
[[nodiscard]] std::vector<SvgPlot> plotsOf(const model::SessionView& session, const ReportSteps& steps);

/// Percent lost of one stream in each step; NaN where nothing was expected.
[[nodiscard]] std::vector<double> lossSeries(const model::Stream& stream, const ReportSteps& steps);
/// Samples a second.
[[nodiscard]] std::vector<double> rateSeries(const model::Stream& stream, const ReportSteps& steps);

} // namespace posewire::exporting
