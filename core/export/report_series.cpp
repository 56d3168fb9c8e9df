// SPDX-License-Identifier: MIT
#include "core/export/report_series.h"

#include "core/model/accounting/attribution.h"

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

model::StreamCounts countsIn(const model::Stream& stream, const ReportSteps& steps, std::size_t step) {
    return stream.accounting.countsBetween(startOf(steps, step), startOf(steps, step + 1));
}

double percentLost(const model::StreamCounts& counts) {
    return counts.expected() == 0 ? kNothing : 100 * counts.lossRatio();
}

struct CharacterSeries {
    std::vector<double> rate;
    std::vector<double> loss;
    std::vector<double> jitter;
};

CharacterSeries seriesOf(const model::SessionView& session, const model::CharacterKey& key,
                         const ReportSteps& steps) {
    CharacterSeries series;
    const auto streams = sampledStreams(session, key);
    for (std::size_t step = 0; step < steps.count; ++step) {
        model::StreamCounts sum;
        std::uint64_t most = 0;
        double jitterMs = kNothing;
        for (const model::Stream* stream : streams) {
            const model::StreamCounts counts = countsIn(*stream, steps, step);
            sum += counts;
            most = std::max(most, counts.samples);
            if (counts.samples != 0) {
                jitterMs = std::fmax(jitterMs, stream->accounting.jitterMsAt(startOf(steps, step + 1)));
            }
        }
        series.rate.push_back(rateOf(most, steps, step));
        series.loss.push_back(percentLost(sum));
        series.jitter.push_back(jitterMs);
    }
    return series;
}

/// Three colours and a grey: unknown is no culprit.
std::size_t colourOf(std::size_t cause) {
    constexpr std::array<std::size_t, model::kLossCauses> colours{1, 0, 3, 6};
    return colours[cause];
}

} // namespace

ReportSteps stepsOf(const model::SessionView& session, const std::optional<model::TimeRange>& range) {
    const model::TimeRange part = range.value_or(model::kAllTime);
    ReportSteps steps;
    log::Stamp first = log::Stamp::max();
    log::Stamp last = log::Stamp::min();
    log::Duration resolution(1);
    for (const model::Stream& stream : session.streams()) {
        first = std::min(first, stream.accounting.firstStamp());
        last = std::max(last, stream.accounting.lastStamp());
        resolution = std::max(resolution, stream.accounting.resolution());
    }
    steps.from = std::max(first, part.from);
    steps.to = std::min(last, part.to);
    if (first > last || steps.from > steps.to) {
        return {};
    }
    const log::Duration least = (steps.to - steps.from) / kMostSteps + log::Duration(1);
    steps.width = (least + resolution - log::Duration(1)) / resolution * resolution;
    steps.first = steps.from - steps.from.time_since_epoch() % steps.width;
    steps.count = static_cast<std::size_t>((steps.to - steps.first) / steps.width + 1);
    return steps;
}

std::vector<SvgPlot> plotsOf(const model::SessionView& session, const ReportSteps& steps) {
    const double durationS = log::secondsOf(steps.width) * static_cast<double>(steps.count);
    std::vector<SvgPlot> plots{
        {"Samples a second, of the fastest stream", SvgPlot::Form::Curves, durationS, {}, 1},
        {"Lost samples, percent of those expected", SvgPlot::Form::Curves, durationS, {}, 1},
        {"Jitter, milliseconds, of the worst stream", SvgPlot::Form::Curves, durationS, {}, 0.1}};
    std::size_t colour = 0;
    for (const model::Character& character : session.characters()) {
        if (colour == kMostCurves) {
            break;
        }
        if (sampledStreams(session, character.key).empty()) {
            continue;
        }
        CharacterSeries series = seriesOf(session, character.key, steps);
        const std::string name = session.displayName(character.key);
        plots[0].series.push_back({name, colour, std::move(series.rate)});
        plots[1].series.push_back({name, colour, std::move(series.loss)});
        plots[2].series.push_back({name, colour, std::move(series.jitter)});
        ++colour;
    }
    return plots;
}

std::vector<const model::Gap*> gapsIn(const model::SessionView& session, const ReportSteps& steps) {
    std::vector<const model::Gap*> gaps;
    for (const model::Gap& gap : session.gaps()) {
        if (gap.lost != 0 && gap.toStamp >= steps.from && gap.toStamp <= steps.to) {
            gaps.push_back(&gap);
        }
    }
    return gaps;
}

SvgPlot causePlot(const model::SessionView& session, const ReportSteps& steps) {
    const double durationS = log::secondsOf(steps.width) * static_cast<double>(steps.count);
    SvgPlot plot{"Samples lost, by cause", SvgPlot::Form::StackedBars, durationS, {}, 1};
    for (std::size_t cause = 0; cause < model::kLossCauses; ++cause) {
        plot.series.push_back({std::string(model::nameOf(static_cast<model::LossCause>(cause))),
                               colourOf(cause), std::vector<double>(steps.count)});
    }
    for (const model::Gap* gap : gapsIn(session, steps)) {
        const std::int64_t step = (gap->toStamp - steps.first) / steps.width;
        auto& values = plot.series[static_cast<std::size_t>(gap->cause)].values;
        values[std::min(static_cast<std::size_t>(step), values.size() - 1)] += gap->lost;
    }
    return plot;
}

std::vector<double> lossSeries(const model::Stream& stream, const ReportSteps& steps) {
    std::vector<double> values;
    for (std::size_t step = 0; step < steps.count; ++step) {
        values.push_back(percentLost(countsIn(stream, steps, step)));
    }
    return values;
}

std::vector<double> rateSeries(const model::Stream& stream, const ReportSteps& steps) {
    std::vector<double> values;
    for (std::size_t step = 0; step < steps.count; ++step) {
        values.push_back(rateOf(countsIn(stream, steps, step).samples, steps, step));
    }
    return values;
}

} // namespace posewire::exporting
