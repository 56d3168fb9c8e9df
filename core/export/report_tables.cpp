// SPDX-License-Identifier: MIT
#include "core/export/report_tables.h"

#include "core/export/html.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace posewire::exporting {
namespace {

std::string cssColour(const model::Colour& colour) {
    const auto part = [](float value) { return std::clamp(std::lround(value * 255), 0L, 255L); };
    std::string text(8, '\0');
    std::snprintf(text.data(), text.size(), "#%02lx%02lx%02lx", static_cast<unsigned long>(part(colour.red)),
                  static_cast<unsigned long>(part(colour.green)),
                  static_cast<unsigned long>(part(colour.blue)));
    text.resize(7);
    return text;
}

const model::Stream* streamOf(const model::Session& session, const log::StreamKey& key) {
    return session.find(key);
}

std::vector<HtmlTable::Column> columns() {
    return {{"Type", false, ""},
            {"Rate", false, "samples a second over time"},
            {"Hz", true, "samples a second between the first and the last"},
            {"Datagrams", true, "well-formed, duplicates included"},
            {"Samples", true, "all datagrams of the sample arrived"},
            {"Lost", true, "expected, and nothing of them arrived"},
            {"Incomplete", true, "some but not all datagrams of the sample arrived"},
            {"Loss %", true, "lost and incomplete, of all expected"},
            {"Loss", false, "percent lost over time"},
            {"Doubled", true, "the same sample and datagram counter came before"},
            {"Reordered", true, "came after a later sample (RFC 4737)"},
            {"Late", true, "reordered by more than 50 ms"},
            {"Restarts", true, "times the sample counter began anew"},
            {"Step", true, "spacing of the sample counter; 0: irregular"},
            {"Longest gap", true, "most samples lost in a row"},
            {"Bursts", true, "of loss (RFC 3611): fewer than 16 samples between two losses"},
            {"Jitter ms", true, "RFC 3550"},
            {"Mean ms", true, "between the arrivals of successive samples"},
            {"Least", true, "milliseconds between successive samples"},
            {"Most", true, "milliseconds between successive samples"},
            {"Deviation", true, "of the time between samples, milliseconds"},
            {"Skew ppm", true, "how much faster the sender's clock goes than ours"},
            {"First", true, "sample counter"},
            {"Last", true, "sample counter"}};
}

std::vector<std::string> sampledCells(const StreamFigures& figures, const std::string& rate,
                                      const std::string& loss) {
    const model::StreamCounts& counts = figures.counts;
    const bool hasLoss = counts.lost + counts.incomplete != 0;
    const auto alarming = [](std::uint64_t count) {
        return count == 0 ? grouped(count) : "<span class=\"warning\">" + grouped(count) + "</span>";
    };
    return {escaped(wire::typeTitle(figures.key.type)),
            rate,
            fixed(figures.rateHz, 2),
            grouped(counts.datagrams),
            grouped(counts.samples),
            alarming(counts.lost),
            alarming(counts.incomplete),
            hasLoss ? "<span class=\"warning\">" + fixed(100 * counts.lossRatio(), 3) + "</span>" : "0",
            hasLoss ? loss : "",
            alarming(counts.duplicates),
            alarming(counts.reordered),
            alarming(counts.late),
            alarming(counts.restarts),
            grouped(counts.step),
            grouped(counts.longestGapSamples),
            grouped(figures.pattern.bursts),
            fixed(figures.clock.jitterMs, 3),
            fixed(figures.arrivals.meanMs, 3),
            fixed(figures.arrivals.leastMs, 3),
            fixed(figures.arrivals.mostMs, 3),
            fixed(figures.arrivals.deviationMs, 3),
            figures.clock.isFromTimeCode ? fixed(figures.clock.skewPpm, 1) : "",
            std::to_string(counts.firstSample),
            std::to_string(counts.lastSample)};
}

/// Types 10 to 13 are sent again and again: only how often, and whether whole, says anything.
std::vector<std::string> unsampledCells(const StreamFigures& figures) {
    std::vector<std::string> cells(columns().size());
    cells[0] = escaped(wire::typeTitle(figures.key.type));
    cells[2] = fixed(figures.rateHz, 2);
    cells[3] = grouped(figures.counts.datagrams);
    cells[6] = grouped(figures.counts.incomplete);
    return cells;
}

} // namespace

std::string streamTable(const model::Session& session, const model::CharacterKey& key,
                        const std::vector<StreamFigures>& figures, const ReportSteps& steps) {
    std::vector<const StreamFigures*> own;
    for (const StreamFigures& one : figures) {
        if (one.key.source == key.source && one.key.character == key.character) {
            own.push_back(&one);
        }
    }
    std::ranges::sort(own, {}, [](const StreamFigures* one) { return one->key.type; });
    HtmlTable table(columns());
    for (const StreamFigures* one : own) {
        const model::Stream* stream = streamOf(session, one->key);
        if (stream == nullptr || !model::countsSamples(one->key.type)) {
            table.add(unsampledCells(*one));
            continue;
        }
        table.add(sampledCells(*one, svgSparkline(rateSeries(*stream, steps), 0),
                               svgSparkline(lossSeries(*stream, steps), 1)));
    }
    return table.html();
}

std::string metadataList(const model::Session& session, const model::CharacterKey& key) {
    std::string html;
    for (const model::MetadataTag& tag : session.metadata(key).tags()) {
        const std::string& value = tag.values.back().text;
        const auto colour = tag.name == "color" ? model::parseColour(value) : std::nullopt;
        html += "<dt>" + escaped(tag.name) + "</dt><dd>" +
                (colour ? "<i class=\"swatch\" style=\"background:" + cssColour(*colour) + "\"></i>" : "") +
                escaped(value) + "</dd>\n";
    }
    return html.empty() ? html : "<dl class=\"facts\">\n" + html + "</dl>\n";
}

std::string utcText(std::int64_t stampNs) {
    using namespace std::chrono;
    const sys_time<milliseconds> stamp{milliseconds(stampNs / 1'000'000)};
    const auto day = floor<days>(stamp);
    const year_month_day date{day};
    const hh_mm_ss time{stamp - day};
    std::string text(64, '\0');
    const int length = std::snprintf(
        text.data(), text.size(), "%04d-%02u-%02u %02d:%02d:%02d.%03d UTC", static_cast<int>(date.year()),
        static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
        static_cast<int>(time.hours().count()), static_cast<int>(time.minutes().count()),
        static_cast<int>(time.seconds().count()), static_cast<int>(time.subseconds().count()));
    text.resize(static_cast<std::size_t>(std::max(length, 0)));
    return text;
}

} // namespace posewire::exporting
