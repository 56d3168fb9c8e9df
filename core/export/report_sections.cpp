// SPDX-License-Identifier: MIT
#include "core/export/report_sections.h"

#include "core/export/html.h"
#include "core/export/reports.h"
#include "core/model/accounting/attribution.h"
#include "core/model/accounting/count_history.h"
#include "core/model/session/accounts.h"
#include "core/model/session/listed_incidents.h"
#include "core/model/session/losses.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/wire/type_table.h"
#include "core/words/say.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posewire::exporting {
namespace {

constexpr std::int64_t kMostSteps = 120;
constexpr std::size_t kMostCurves = 8;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::vector<const model::Stream*> sampledStreams(const model::SessionView& session,
                                                 const model::CharacterKey& key) {
    std::vector<const model::Stream*> streams = streamsByType(session, key);
    std::erase_if(streams, [](const auto* stream) { return !model::countsSamples(stream->key.type); });
    return streams;
}

double plottedS(const ReportSteps& steps) {
    return log::secondsOf(steps.width) * static_cast<double>(steps.count);
}

log::Stamp startOf(const ReportSteps& steps, std::size_t step) {
    return steps.first + static_cast<std::int64_t>(step) * steps.width;
}

/// Samples a second of a step. A step that the report covers by a sliver says nothing of a rate.
double rateOf(std::uint64_t samples, const ReportSteps& steps, std::size_t step) {
    const log::Stamp from = std::max(startOf(steps, step), steps.from);
    const log::Stamp to = std::min(startOf(steps, step + 1), steps.to);
    const double seconds = log::secondsOf(std::max(to - from, log::Duration::zero()));
    const bool isCovered = seconds > 0.3e-9 * static_cast<double>(steps.width.count());
    return isCovered ? static_cast<double>(samples) / seconds : kNothing;
}

/// Of some streams in each step; NaN where nothing was expected.
struct Series {
    std::vector<double> rate;   ///< samples a second, of the fastest
    std::vector<double> loss;   ///< percent of all
    std::vector<double> jitter; ///< milliseconds, of the worst
};

Series seriesOf(std::span<const model::Stream* const> streams, const ReportSteps& steps) {
    Series series;
    for (std::size_t step = 0; step < steps.count; ++step) {
        model::StreamCounts sum;
        std::uint64_t most = 0;
        double jitterMs = kNothing;
        for (const model::Stream* stream : streams) {
            const auto& accounting = stream->accounting;
            const auto counts = accounting.countsBetween(startOf(steps, step), startOf(steps, step + 1));
            sum += counts;
            most = std::max(most, counts.samples);
            if (counts.samples != 0) {
                jitterMs = std::fmax(jitterMs, accounting.history().jitterMsAt(startOf(steps, step + 1)));
            }
        }
        series.rate.push_back(rateOf(most, steps, step));
        series.loss.push_back(sum.expected() == 0 ? kNothing : 100 * sum.lossRatio());
        series.jitter.push_back(jitterMs);
    }
    return series;
}

/// Rate, loss and jitter over time; a curve for each character, of its fastest, all and its worst stream.
std::vector<SvgPlot> plotsOf(const model::SessionView& session, const ReportSteps& steps) {
    const double durationS = plottedS(steps);
    std::vector<SvgPlot> plots{
        {"Samples a second, of the fastest stream", SvgPlot::Form::Curves, durationS, {}, 1},
        {"Lost samples, percent of those expected", SvgPlot::Form::Curves, durationS, {}, 1},
        {"Jitter, milliseconds, of the worst stream", SvgPlot::Form::Curves, durationS, {}, 0.1}};
    for (const model::Character& character : session.roster().characters()) {
        const std::size_t colour = plots[0].series.size();
        const auto streams = sampledStreams(session, character.key);
        if (colour == kMostCurves || streams.empty() || !character.isConfirmed) {
            continue;
        }
        Series series = seriesOf(streams, steps);
        const std::string name = session.roster().displayName(character.key).shown();
        plots[0].series.push_back({name, colour, std::move(series.rate)});
        plots[1].series.push_back({name, colour, std::move(series.loss)});
        plots[2].series.push_back({name, colour, std::move(series.jitter)});
    }
    return plots;
}

/// The gaps with losses that end within the report, in the order of the session.
std::vector<const model::Gap*> gapsIn(const model::SessionView& session, const ReportSteps& steps) {
    std::vector<const model::Gap*> gaps;
    for (const model::Gap& gap : session.accounts().attribution().gaps()) {
        if (gap.lost != 0 && gap.toStamp >= steps.from && gap.toStamp <= steps.to) {
            gaps.push_back(&gap);
        }
    }
    return gaps;
}

/// Samples of which nothing or not all came, over time, in a colour for each cause.
SvgPlot causePlot(const model::SessionView& session, const ReportSteps& steps) {
    // Colours and a grey: unknown is no culprit.
    constexpr std::array<std::size_t, model::kLossCauses> kColours{1, 0, 3, 6, 2};
    SvgPlot plot{"Samples lost, by cause", SvgPlot::Form::StackedBars, plottedS(steps), {}, 1};
    const bool hasProbes = std::ranges::any_of(
        session.roster().senders(), [](const model::Sender& sender) { return !sender.info.probe.empty(); });
    const std::size_t causes = hasProbes ? model::kLossCauses : model::kLossCauses - 1;
    for (std::size_t cause = 0; cause < causes; ++cause) {
        plot.series.push_back({std::string(model::nameOf(static_cast<model::LossCause>(cause))),
                               kColours[cause], std::vector<double>(steps.count)});
    }
    const auto add = [&](log::Stamp stamp, model::LossCause cause, double samples) {
        const std::int64_t step = (stamp - steps.first) / steps.width;
        auto& values = plot.series[static_cast<std::size_t>(cause)].values;
        values[std::min(static_cast<std::size_t>(step), values.size() - 1)] += samples;
    };
    for (const model::Gap* gap : gapsIn(session, steps)) {
        for (std::size_t cause = 0; cause < causes; ++cause) {
            add(gap->toStamp, static_cast<model::LossCause>(cause), gap->shares[cause].lost);
        }
    }
    session.accounts().attribution().forEachPartialLoss(
        [&](const log::StreamKey& key, log::Stamp stamp, model::LossCause cause, std::uint64_t /*packet*/) {
            if (model::countsSamples(key.type) && stamp >= steps.from && stamp <= steps.to) {
                add(stamp, cause, 1);
            }
        });
    return plot;
}

// More of them nobody reads.
constexpr std::size_t kMostEvents = 300;
constexpr std::size_t kMostGaps = 100;

/// "The newest 300 of 1,234 events.", or "12 events." where all are listed.
std::string listed(const std::string& which, std::size_t count, std::size_t all, const std::string& what) {
    const std::string text =
        count < all ? "The " + which + ' ' + grouped(count) + " of " + grouped(all) : grouped(all);
    return "<p class=\"dim\">" + text + ' ' + what + (all == 1 ? "" : "s") + ".</p>\n";
}

/// Sender, character and type, as far as the event is about them.
std::string whose(const model::SessionView& session, const model::Incident& event) {
    std::string text;
    for (const model::ForeignText& address : addressesOf(session, event)) {
        text += (text.empty() ? "" : ", ") + address.shown();
    }
    for (const model::CharacterKey& character : event.characters()) {
        text += ", " + session.roster().displayName(character).shown();
    }
    const auto types = event.types();
    if (types.size() == 1) {
        text += ", " + wire::typeTitle(types.front());
    } else if (!types.empty()) {
        text += ", " + std::to_string(types.size()) + " types";
    }
    return text;
}

std::string secondsAfter(log::Stamp stamp, const ReportSteps& steps) {
    return fixed(log::secondsOf(stamp - steps.from), 3);
}

std::vector<std::string> cellsOf(const model::SessionView& session, const model::Gap& gap,
                                 const ReportSteps& steps) {
    const model::CharacterKey key{gap.stream.sender, gap.stream.character};
    std::string causes;
    std::string evidence;
    for (const model::LossCause cause : gap.causes()) {
        causes += (causes.empty() ? "" : ", ") + std::string(model::nameOf(cause));
        evidence += (evidence.empty() ? "" : " ") + say(gap.evidenceFact(cause), words::Form::Sentence);
    }
    return {fixed(log::millisecondsOf(gap.fromStamp - steps.from) * 1e-3, 3),
            session.roster().displayName(key).html() + ", " + escaped(wire::typeTitle(gap.stream.type)),
            grouped(gap.lost),
            std::to_string(gap.fromSample) + "–" + std::to_string(gap.toSample),
            fixed(log::millisecondsOf(gap.toStamp - gap.fromStamp), 1),
            escaped(causes),
            escaped(evidence)};
}

using enum model::Figure;

constexpr std::array kRate{RateWhole, Datagrams, Samples, Lost, Incomplete, LossShare};
constexpr std::array kOrder{Duplicates, Reordered, Late, Restarts};
constexpr std::array kTiming{Jitter, SpacingMean, SpacingLeast, SpacingMost, SpacingDeviation,
                             Skew,   Drift,       LongestGap,   Bursts,      BurstDensity,
                             Step,   FirstSample, LastSample};

void addColumns(std::vector<HtmlTable::Column>& columns, std::span<const model::Figure> figures) {
    for (const model::Figure figure : figures) {
        columns.push_back({model::rowOf(figure).title, true, model::rowOf(figure).help});
    }
}

/// Empty where a figure says nothing.
std::string cellOf(const model::StreamFigures& figures, model::Figure figure) {
    const model::FigureRow& row = model::rowOf(figure);
    const double value = figures[figure];
    const bool isOnlyWithLoss = figure == BurstDensity || (figure == RateWhole && !figures.isSampled());
    const bool isOnlyWithTimeCode = row.style.form == model::FigureForm::Signed;
    if (!figures.has(figure) || std::isnan(value) || (isOnlyWithLoss && value == 0) ||
        (isOnlyWithTimeCode && !figures.isFromTimeCode())) {
        return {};
    }
    return figure == LossShare && value == 0 ? "0" : figureText(figures, figure, row.style.digits.report);
}

void addCells(std::vector<std::string>& cells, const model::StreamFigures& figures,
              std::span<const model::Figure> shown) {
    for (const model::Figure figure : shown) {
        const std::string text = cellOf(figures, figure);
        const bool isTrouble = !text.empty() && figures.trouble(figure) != model::FigureTrouble::None;
        cells.push_back(isTrouble ? "<span class=\"warning\">" + text + "</span>" : text);
    }
}

/// Types 10 to 13 are sent again and again: only how often, and whether whole, says anything.
std::vector<std::string> deliveryCells(const model::StreamFigures& figures, const model::Stream& stream,
                                       const ReportSteps& steps) {
    const bool isSampled = figures.isSampled();
    const Series series = isSampled ? seriesOf(std::array{&stream}, steps) : Series();
    std::vector<std::string> cells{escaped(wire::typeTitle(stream.key.type)),
                                   isSampled ? svgSparkline(series.rate, 0) : ""};
    addCells(cells, figures, kRate);
    cells.push_back(isSampled && figures[Missing] > 0 ? svgSparkline(series.loss, 1) : "");
    addCells(cells, figures, kOrder);
    return cells;
}

std::vector<std::string> timingCells(const model::StreamFigures& figures) {
    std::vector<std::string> cells{escaped(wire::typeTitle(figures.key().type))};
    for (const model::Figure figure : kTiming) {
        cells.push_back(cellOf(figures, figure));
    }
    return cells;
}

HtmlTable tableOf(const std::string& title, std::span<const model::Figure> figures) {
    std::vector<HtmlTable::Column> columns{{title, false, ""}};
    addColumns(columns, figures);
    return HtmlTable(columns);
}

} // namespace

ReportSteps stepsOf(const model::SessionView& session, const std::optional<model::TimeRange>& range) {
    const model::TimeRange part = range.value_or(model::kAllTime);
    ReportSteps steps;
    log::Stamp first = log::Stamp::max();
    log::Stamp last = log::Stamp::min();
    log::Duration resolution(1);
    for (const model::Stream& stream : session.roster().streams()) {
        first = std::min(first, stream.accounting.firstStamp());
        last = std::max(last, stream.accounting.lastStamp());
        resolution = std::max(resolution, stream.accounting.resolution(part.from));
    }
    steps.from = std::max(first, part.from);
    steps.to = std::min(last, part.to);
    if (first > last || steps.from > steps.to) {
        return {};
    }
    const log::Duration least = (steps.to - steps.from) / kMostSteps + log::Duration(1);
    steps.width = model::roundedUp(least, resolution);
    steps.first = model::roundedDown(steps.from, steps.width);
    steps.count = static_cast<std::size_t>((steps.to - steps.first) / steps.width + 1);
    return steps;
}

std::string_view severityName(model::IncidentSeverity severity) {
    constexpr std::array<std::string_view, 3> names{"good", "warning", "error"};
    return names[static_cast<std::size_t>(severity)];
}

std::string_view severityMark(model::IncidentSeverity severity) {
    constexpr std::array<std::string_view, 3> marks{"●", "▲", "■"};
    return marks[static_cast<std::size_t>(severity)];
}

std::string plotSection(const model::SessionView& session, const ReportSteps& steps) {
    if (steps.count < 2) {
        return {};
    }
    std::string html = "<h2>Over time</h2>\n<div class=\"plots\">\n";
    for (const SvgPlot& plot : plotsOf(session, steps)) {
        html += svgPlot(plot);
    }
    return html + svgPlot(causePlot(session, steps)) + "</div>\n";
}

std::string streamTable(const model::SessionView& session, const model::CharacterKey& key,
                        const std::vector<model::StreamFigures>& figures, const ReportSteps& steps) {
    std::vector<HtmlTable::Column> columns{{"What arrived", false, ""},
                                           {"Over time", false, "samples per second"}};
    addColumns(columns, kRate);
    columns.push_back({"Over time", false, "percent lost"});
    addColumns(columns, kOrder);
    HtmlTable delivery(columns);
    HtmlTable timing = tableOf("When it arrived", kTiming);
    const auto causes = model::causeFiguresOf(session.roster().find(key.sender)->info);
    HtmlTable losses = tableOf("Whose loss", causes);
    for (const model::Stream* stream : streamsByType(session, key)) {
        const auto own = std::ranges::find(figures, stream->key, &model::StreamFigures::key);
        if (own == figures.end()) {
            continue; // nothing in the range
        }
        delivery.add(deliveryCells(*own, *stream, steps));
        if (own->isSampled()) {
            timing.add(timingCells(*own));
        }
        if (std::ranges::any_of(causes, [&](model::Figure cause) { return own->count(cause) != 0; })) {
            std::vector<std::string> cells{escaped(wire::typeTitle(own->key().type))};
            addCells(cells, *own, causes);
            losses.add(cells);
        }
    }
    return delivery.html() + (losses.isEmpty() ? "" : losses.html()) +
           (timing.isEmpty() ? "" : timing.html());
}

std::string metadataList(const model::SessionView& session, const model::CharacterKey& key) {
    std::string html;
    for (const model::MetadataTag& tag : session.messages().metadata(key).tags()) {
        const model::ForeignText& value = tag.values.back().text;
        const auto colour = tag.name == "color" ? model::parseColour(value.shown()) : std::nullopt;
        html += "<dt>" + tag.name.html() + "</dt><dd>" +
                (colour ? "<i class=\"swatch\" style=\"background:" + model::colourText(*colour) + "\"></i>"
                        : "") +
                value.html() + "</dd>\n";
    }
    return html.empty() ? html : "<dl class=\"facts\">\n" + html + "</dl>\n";
}

std::string gapSection(const model::SessionView& session, const ReportSteps& steps) {
    std::vector<const model::Gap*> gaps = gapsIn(session, steps);
    if (gaps.empty()) {
        return {};
    }
    const std::size_t all = gaps.size();
    std::ranges::stable_sort(gaps, std::greater{}, [](const model::Gap* gap) { return gap->lost; });
    gaps.resize(std::min(all, kMostGaps));
    std::ranges::stable_sort(gaps, {}, [](const model::Gap* gap) { return gap->fromStamp; });
    HtmlTable table({{"At s", true, "seconds since the report's beginning"},
                     {"Stream", false, ""},
                     {"Lost", true, "samples"},
                     {"Between", true, "the samples around it, which arrived"},
                     {"Lasted ms", true, "between the arrivals of the samples around it"},
                     {"Whose loss", false, ""},
                     {"Evidence", false, ""}});
    for (const model::Gap* gap : gaps) {
        table.add(cellsOf(session, *gap, steps));
    }
    return "<h2>Gaps</h2>\n" + listed("longest", gaps.size(), all, "gap") + table.html();
}

std::string eventSection(const model::SessionView& session, const ReportSteps& steps) {
    std::vector<model::Incident> events;
    for (const model::Incident& event : session.verdicts().incidents().all()) {
        const auto its = model::withinRange(session, {event, model::stateOf(session, event)},
                                            {steps.from, steps.to + log::Duration(1)});
        if (its && its->incident.count != 0) {
            events.push_back(its->incident);
        }
    }
    if (events.empty()) {
        return {};
    }
    const std::size_t all = events.size();
    const auto left = static_cast<std::ptrdiff_t>(all - std::min(all, kMostEvents));
    HtmlTable table({{"From s", true, "seconds since the report's beginning"},
                     {"To s", true, "seconds since the report's beginning"},
                     {"What", false, ""},
                     {"Whose", false, ""},
                     {"Times", true, "how often it happened in this episode"},
                     {"In words", false, ""}});
    std::for_each(events.begin() + left, events.end(), [&](const model::Incident& event) {
        const std::string name(severityName(event.severity()));
        const std::string mark = event.severity() == model::IncidentSeverity::Info
                                     ? ""
                                     : "<span class=\"" + name + "\" aria-label=\"" + name + "\">" +
                                           std::string(severityMark(event.severity())) + "</span> ";
        table.add({secondsAfter(event.firstStamp, steps), secondsAfter(event.lastStamp, steps),
                   mark + escaped(model::nameOf(event.kind)), escaped(whose(session, event)),
                   grouped(event.count), escaped(say(event.fact(), words::Form::Sentence))});
    });
    return "<h2>Incidents</h2>\n" + listed("newest", std::min(all, kMostEvents), all, "incident") +
           table.html();
}

} // namespace posewire::exporting
