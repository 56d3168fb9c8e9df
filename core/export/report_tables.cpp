// SPDX-License-Identifier: MIT
#include "core/export/report_tables.h"

#include "core/export/html.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace posewire::exporting {
namespace {

std::string cssColour(const model::Colour& colour) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const float part : {colour.red, colour.green, colour.blue}) {
        const auto value = static_cast<std::size_t>(std::clamp(std::lround(part * 255), 0L, 255L));
        text += digits[value >> 4];
        text += digits[value & 0xf];
    }
    return text;
}

/// With zeros in front.
std::string padded(std::int64_t number, std::size_t width) {
    const std::string digits = std::to_string(number);
    return std::string(width - std::min(width, digits.size()), '0') + digits;
}

std::string alarming(std::uint64_t count) {
    return count == 0 ? grouped(count) : "<span class=\"warning\">" + grouped(count) + "</span>";
}

std::vector<HtmlTable::Column> deliveryColumns() {
    return {{"What arrived", false, ""},
            {"Over time", false, "samples a second"},
            {"Hz", true, "samples a second between the first and the last"},
            {"Datagrams", true, "well-formed, duplicates included"},
            {"Samples", true, "all datagrams of the sample arrived"},
            {"Lost", true, "expected, and nothing of them arrived"},
            {"Incomplete", true, "some but not all datagrams of the sample arrived"},
            {"Loss %", true, "lost and incomplete, of all expected"},
            {"Over time", false, "percent lost"},
            {"Duplicates", true, "the same sample and datagram counter came before"},
            {"Reordered", true, "came after a later sample (RFC 4737)"},
            {"Late", true, "reordered by more than 50 ms"},
            {"Restarts", true, "times the sample counter began anew"}};
}

std::vector<std::string> deliveryCells(const StreamFigures& figures, const model::Stream& stream,
                                       const ReportSteps& steps) {
    const model::StreamCounts& counts = figures.counts;
    const bool hasLoss = counts.lost + counts.incomplete != 0;
    return {escaped(wire::typeTitle(figures.key.type)),
            svgSparkline(rateSeries(stream, steps), 0),
            fixed(figures.rateHz, 2),
            grouped(counts.datagrams),
            grouped(counts.samples),
            alarming(counts.lost),
            alarming(counts.incomplete),
            hasLoss ? "<span class=\"warning\">" + fixed(100 * counts.lossRatio(), 3) + "</span>" : "0",
            hasLoss ? svgSparkline(lossSeries(stream, steps), 1) : "",
            alarming(counts.duplicates),
            alarming(counts.reordered),
            alarming(counts.late),
            alarming(counts.restarts)};
}

/// Types 10 to 13 are sent again and again: only how often, and whether whole, says anything.
std::vector<std::string> messageCells(const StreamFigures& figures) {
    std::vector<std::string> cells(deliveryColumns().size());
    cells[0] = escaped(wire::typeTitle(figures.key.type));
    cells[2] = figures.rateHz > 0 ? fixed(figures.rateHz, 2) : "";
    cells[3] = grouped(figures.counts.datagrams);
    cells[6] = alarming(figures.counts.incomplete);
    return cells;
}

std::vector<HtmlTable::Column> timingColumns() {
    return {{"When it arrived", false, ""},
            {"Jitter ms", true, "RFC 3550"},
            {"Mean ms", true, "between the arrivals of successive samples"},
            {"Least ms", true, "between the arrivals of successive samples"},
            {"Most ms", true, "between the arrivals of successive samples"},
            {"Deviation ms", true, "of the time between the arrivals of successive samples"},
            {"Skew ppm", true, "how much faster the sender's clock goes than ours; needs time codes"},
            {"Drift ms", true, "what that made since the first sample"},
            {"Longest gap", true, "most samples lost in a row"},
            {"Bursts", true, "of loss (RFC 3611): fewer than 16 samples between two losses"},
            {"Burst %", true, "samples lost, of those in bursts"},
            {"Step", true, "spacing of the sample counter; 0: irregular"},
            {"First", true, "sample counter"},
            {"Last", true, "sample counter"}};
}

std::vector<std::string> timingCells(const StreamFigures& figures) {
    const model::StreamCounts& counts = figures.counts;
    return {escaped(wire::typeTitle(figures.key.type)),
            fixed(figures.clock.jitterMs, 3),
            fixed(figures.arrivals.meanMs, 3),
            fixed(figures.arrivals.leastMs, 3),
            fixed(figures.arrivals.mostMs, 3),
            fixed(figures.arrivals.deviationMs, 3),
            figures.clock.isFromTimeCode ? fixed(figures.clock.skewPpm, 1) : "",
            figures.clock.isFromTimeCode ? fixed(figures.clock.driftMs, 3) : "",
            grouped(counts.longestGapSamples),
            grouped(figures.pattern.bursts),
            figures.pattern.bursts != 0 ? fixed(100 * figures.pattern.burstDensity, 1) : "",
            grouped(counts.step),
            std::to_string(counts.firstSample),
            std::to_string(counts.lastSample)};
}

} // namespace

std::string streamTable(const model::SessionView& session, const model::CharacterKey& key,
                        const std::vector<StreamFigures>& figures, const ReportSteps& steps) {
    std::vector<const StreamFigures*> own;
    for (const StreamFigures& one : figures) {
        if (one.key.sender == key.sender && one.key.character == key.character) {
            own.push_back(&one);
        }
    }
    std::ranges::sort(own, {}, [](const StreamFigures* one) { return one->key.type; });
    HtmlTable delivery(deliveryColumns());
    HtmlTable timing(timingColumns());
    for (const StreamFigures* one : own) {
        const model::Stream* stream = session.find(one->key);
        if (stream == nullptr || !model::countsSamples(one->key.type)) {
            delivery.add(messageCells(*one));
            continue;
        }
        delivery.add(deliveryCells(*one, *stream, steps));
        timing.add(timingCells(*one));
    }
    return delivery.html() + (timing.isEmpty() ? "" : timing.html());
}

std::string metadataList(const model::SessionView& session, const model::CharacterKey& key) {
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
    return padded(static_cast<int>(date.year()), 4) + '-' + padded(static_cast<unsigned>(date.month()), 2) +
           '-' + padded(static_cast<unsigned>(date.day()), 2) + ' ' + padded(time.hours().count(), 2) + ':' +
           padded(time.minutes().count(), 2) + ':' + padded(time.seconds().count(), 2) + '.' +
           padded(time.subseconds().count(), 3) + " UTC";
}

} // namespace posewire::exporting
