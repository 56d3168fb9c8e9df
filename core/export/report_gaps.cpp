// SPDX-License-Identifier: MIT
#include "core/export/report_gaps.h"

#include "core/export/html.h"
#include "core/model/accounting/attribution.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::exporting {
namespace {

using model::Gap;

/// More of them nobody reads; the longest tell the story.
constexpr std::size_t kMostListed = 100;

std::vector<const Gap*> gapsIn(const model::SessionView& session, const ReportSteps& steps) {
    std::vector<const Gap*> gaps;
    for (const Gap& gap : session.gaps()) {
        if (gap.lost != 0 && gap.toStamp >= steps.from && gap.toStamp <= steps.to) {
            gaps.push_back(&gap);
        }
    }
    return gaps;
}

/// Three colours and a grey: unknown is no culprit.
std::size_t colourOf(std::size_t cause) {
    constexpr std::array<std::size_t, model::kLossCauses> colours{1, 0, 3, 6};
    return colours[cause];
}

std::vector<std::string> cellsOf(const model::SessionView& session, const Gap& gap,
                                 const ReportSteps& steps) {
    const model::CharacterKey key{gap.stream.sender, gap.stream.character};
    return {fixed(log::millisecondsOf(gap.fromStamp - steps.from) * 1e-3, 3),
            escaped(session.displayName(key)) + ", " + escaped(wire::typeTitle(gap.stream.type)),
            grouped(gap.lost),
            std::to_string(gap.fromSample) + "–" + std::to_string(gap.toSample),
            fixed(log::millisecondsOf(gap.toStamp - gap.fromStamp), 1),
            escaped(model::nameOf(gap.cause)),
            escaped(gap.evidenceText())};
}

} // namespace

SvgPlot causePlot(const model::SessionView& session, const ReportSteps& steps) {
    const double durationS = log::secondsOf(steps.width) * static_cast<double>(steps.count);
    SvgPlot plot{"Samples lost, by cause", SvgPlot::Form::StackedBars, durationS, {}, 1};
    for (std::size_t cause = 0; cause < model::kLossCauses; ++cause) {
        plot.series.push_back({std::string(model::nameOf(static_cast<model::LossCause>(cause))),
                               colourOf(cause), std::vector<double>(steps.count)});
    }
    for (const Gap* gap : gapsIn(session, steps)) {
        const std::int64_t step = (gap->toStamp - steps.first) / steps.width;
        auto& values = plot.series[static_cast<std::size_t>(gap->cause)].values;
        values[std::min(static_cast<std::size_t>(step), values.size() - 1)] += gap->lost;
    }
    return plot;
}

std::string gapSection(const model::SessionView& session, const ReportSteps& steps) {
    std::vector<const Gap*> gaps = gapsIn(session, steps);
    if (gaps.empty()) {
        return {};
    }
    const std::size_t all = gaps.size();
    std::ranges::stable_sort(gaps, std::greater{}, [](const Gap* gap) { return gap->lost; });
    gaps.resize(std::min(all, kMostListed));
    std::ranges::stable_sort(gaps, {}, [](const Gap* gap) { return gap->fromStamp; });
    HtmlTable table({{"At s", true, "seconds since the report's beginning"},
                     {"Stream", false, ""},
                     {"Lost", true, "samples"},
                     {"Between", true, "the samples around it, which came"},
                     {"Lasted ms", true, "between the arrivals of the samples around it"},
                     {"Whose loss", false, ""},
                     {"Evidence", false, ""}});
    for (const Gap* gap : gaps) {
        table.add(cellsOf(session, *gap, steps));
    }
    const std::string count = all > gaps.size()
                                  ? "The longest " + grouped(gaps.size()) + " of " + grouped(all) + " gaps."
                                  : grouped(all) + (all == 1 ? " gap." : " gaps.");
    return "<h2>Gaps</h2>\n<p class=\"dim\">" + count + "</p>\n" + table.html();
}

} // namespace posewire::exporting
