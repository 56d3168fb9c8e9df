// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/html.h"
#include "core/export/session_reading.h"
#include "core/log/time.h"

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

/// Rate, loss and jitter over time; a curve for each character, of its fastest, all and its worst stream.
[[nodiscard]] std::vector<SvgPlot> plotsOf(const model::SessionView& session, const ReportSteps& steps);

/// The gaps with losses that end within the report, in the order of the session.
[[nodiscard]] std::vector<const model::Gap*> gapsIn(const model::SessionView& session,
                                                    const ReportSteps& steps);
/// Samples lost over time, in a colour for each cause.
[[nodiscard]] SvgPlot causePlot(const model::SessionView& session, const ReportSteps& steps);

/// Percent lost of one stream in each step; NaN where nothing was expected.
[[nodiscard]] std::vector<double> lossSeries(const model::Stream& stream, const ReportSteps& steps);
/// Samples a second.
[[nodiscard]] std::vector<double> rateSeries(const model::Stream& stream, const ReportSteps& steps);

} // namespace posewire::exporting
