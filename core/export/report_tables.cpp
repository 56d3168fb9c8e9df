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

std::vector<HtmlTable::Column> deliveryColumns() {
    std::vector<HtmlTable::Column> columns{{"What arrived", false, ""},
                                           {"Over time", false, "samples per second"}};
    addColumns(columns, kRate);
    columns.push_back({"Over time", false, "percent lost"});
    addColumns(columns, kOrder);
    return columns;
}

std::vector<HtmlTable::Column> timingColumns() {
    std::vector<HtmlTable::Column> columns{{"When it arrived", false, ""}};
    addColumns(columns, kTiming);
    return columns;
}

/// Empty where a figure says nothing.
std::string cellOf(const model::StreamFigures& figures, model::Figure figure) {
    const model::FigureRow& row = model::rowOf(figure);
    const double value = figures[figure];
    const bool isOnlyWithLoss = figure == BurstDensity || (figure == RateWhole && !figures.isSampled());
    const bool isOnlyWithTimeCode = row.style.form == model::FigureForm::Signed;
    if (!figures.has(figure) || (isOnlyWithLoss && value == 0) ||
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
    std::vector<std::string> cells{escaped(wire::typeTitle(stream.key.type)),
                                   isSampled ? svgSparkline(rateSeries(stream, steps), 0) : ""};
    addCells(cells, figures, kRate);
    cells.push_back(isSampled && figures[Missing] > 0 ? svgSparkline(lossSeries(stream, steps), 1) : "");
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

} // namespace

std::string streamTable(const model::SessionView& session, const model::CharacterKey& key,
                        const std::vector<model::StreamFigures>& figures, const ReportSteps& steps) {
    HtmlTable delivery(deliveryColumns());
    HtmlTable timing(timingColumns());
    for (const model::Stream* stream : streamsByType(session, key)) {
        const auto own = std::ranges::find(figures, stream->key, &model::StreamFigures::key);
        if (own == figures.end()) {
            continue; // nothing in the range
        }
        delivery.add(deliveryCells(*own, *stream, steps));
        if (own->isSampled()) {
            timing.add(timingCells(*own));
        }
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

std::string utcText(log::Stamp stamp) {
    using namespace std::chrono;
    const auto shown = time_point_cast<milliseconds>(stamp);
    const auto day = floor<days>(shown);
    const year_month_day date{day};
    const hh_mm_ss time{shown - day};
    return padded(static_cast<int>(date.year()), 4) + '-' + padded(static_cast<unsigned>(date.month()), 2) +
           '-' + padded(static_cast<unsigned>(date.day()), 2) + ' ' + padded(time.hours().count(), 2) + ':' +
           padded(time.minutes().count(), 2) + ':' + padded(time.seconds().count(), 2) + '.' +
           padded(time.subseconds().count(), 3) + " UTC";
}

} // namespace posewire::exporting
