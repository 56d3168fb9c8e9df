// SPDX-License-Identifier: MIT
#include "core/export/report_series.h"

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

std::int64_t startOf(const ReportSteps& steps, std::size_t step) {
    return steps.firstNs + static_cast<std::int64_t>(step) * steps.widthNs;
}

/// How much of a step the report covers, in seconds.
double coveredS(const ReportSteps& steps, std::size_t step) {
    const std::int64_t from = std::max(startOf(steps, step), steps.fromNs);
    const std::int64_t to = std::min(startOf(steps, step + 1), steps.toNs);
    return static_cast<double>(std::max<std::int64_t>(to - from, 0)) * 1e-9;
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
        // An end that is covered by a sliver tells nothing of a rate.
        const double seconds = coveredS(steps, step);
        const bool isCovered = seconds > 0.3e-9 * static_cast<double>(steps.widthNs);
        series.rate.push_back(isCovered ? static_cast<double>(most) / seconds : kNothing);
        series.loss.push_back(percentLost(sum));
        series.jitter.push_back(jitterMs);
    }
    return series;
}

} // namespace

ReportSteps stepsOf(const model::SessionView& session, const std::optional<model::TimeRange>& range) {
    const model::TimeRange part = range.value_or(model::kAllTime);
    ReportSteps steps;
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    std::int64_t last = std::numeric_limits<std::int64_t>::min();
    std::int64_t resolution = 1;
    for (const model::Stream& stream : session.streams()) {
        first = std::min(first, stream.accounting.firstStampNs());
        last = std::max(last, stream.accounting.lastStampNs());
        resolution = std::max(resolution, stream.accounting.resolutionNs());
    }
    steps.fromNs = std::max(first, part.fromNs);
    steps.toNs = std::min(last, part.toNs);
    if (first > last || steps.fromNs > steps.toNs) {
        return {};
    }
    const std::int64_t least = (steps.toNs - steps.fromNs) / kMostSteps + 1;
    steps.widthNs = (least + resolution - 1) / resolution * resolution;
    steps.firstNs = steps.fromNs / steps.widthNs * steps.widthNs;
    steps.count = static_cast<std::size_t>((steps.toNs - steps.firstNs) / steps.widthNs + 1);
    return steps;
}

std::vector<SvgPlot> plotsOf(const model::SessionView& session, const ReportSteps& steps) {
    const double durationS = static_cast<double>(steps.widthNs) * 1e-9 * static_cast<double>(steps.count);
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
        const double seconds = coveredS(steps, step);
        const bool isCovered = seconds > 0.3e-9 * static_cast<double>(steps.widthNs);
        values.push_back(isCovered ? static_cast<double>(countsIn(stream, steps, step).samples) / seconds
                                   : kNothing);
    }
    return values;
}

} // namespace posewire::exporting
