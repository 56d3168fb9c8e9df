// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/statistics_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/export/sheets.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace posewire::gui {

namespace {

using enum model::Figure;

struct Column {
    std::optional<model::Figure> figure;
    const char* usual = "9999.99";
    int order = ColumnRoom::kOnChoice;
};

/// Shown are those that decide whether a stream is good, and whose fault it is if not; the others on choice.
/// Whose fault it was stays longest; other docks have the rate and what was dropped here, too.
constexpr std::array<Column, kStatisticsColumns> kColumns{{
    {std::nullopt, "    02 Pose, quaternion", 0},
    {Rate, "9999.9", 2},
    {LossShare, "▲ 99.99", 7},
    {LostHere, "▲ 9999", 3},
    {LostOnNetwork, "▲ 9999", 6},
    {LostAtSender, "▲ 9999", 5},
    {LostUnknown, "▲ 9999", 4},
    {Jitter, "999.99", 1},
    {Lost, "▲ 9999"},
    {Reordered, "99999"},
    {std::nullopt, "0000000"},
    {Duplicates},
    {Late},
    {Incomplete},
    {Restarts},
    {Malformed, "■ 9999"},
    {Bandwidth},
    {LongestGap},
    {SpacingMost},
    {SpacingDeviation},
    {SpacingMean},
    {SpacingLeast},
    {RateMean},
    {RateLeast},
    {RateMost},
    {RateDeviation},
    {Bursts},
    {BurstLength},
    {BurstDensity},
    {GapDensity},
    {Skew},
    {Drift},
    {Samples, "99 999 999"},
    {Datagrams, "99 999 999"},
    {DatagramRate},
    {Step, "99"},
}};

/// Shorter parts show the beat of samples and buckets, not the rate.
constexpr log::Duration kLeastPart = std::chrono::milliseconds(500);
constexpr log::Duration kLeastOverviewPart = std::chrono::seconds(1);

/// A figure as it is shown; empty if the row has none of that kind.
QString figureText(const model::StreamFigures& figures, model::Figure figure) {
    const model::FigureStyle& style = model::rowOf(figure).style;
    const double value = figures[figure];
    if (!figures.has(figure)) {
        return {};
    }
    switch (style.form) {
    case model::FigureForm::Count:
    case model::FigureForm::Counter:
        return grouped(figures.count(figure));
    case model::FigureForm::Share:
        return fixed(100 * value, style.digits.window);
    case model::FigureForm::Signed:
        return signedFixed(value, style.digits.window);
    case model::FigureForm::Number:
        break;
    }
    return fixed(value, style.digits.window);
}

/// The same number as programs read it; empty also where it is not known.
QString figureNumber(const model::StreamFigures& figures, model::Figure figure) {
    const model::FigureStyle& style = model::rowOf(figure).style;
    const double value = (style.form == model::FigureForm::Share ? 100 : 1) * figures[figure];
    if (!figures.has(figure) || !std::isfinite(value)) {
        return {};
    }
    const bool isZero = std::abs(value) * std::pow(10, style.digits.window) < 0.5; // which has no sign
    return QString::number(isZero ? 0 : value, 'f', style.digits.window);
}

/// Unknown for all that is neither good nor bad.
Health figureHealth(const model::StreamFigures& figures, model::Figure figure) {
    using enum Health;
    constexpr std::array kHealths{Unknown, Unknown, Warning, Error}; // by FigureTrouble
    return kHealths[static_cast<std::size_t>(figures.trouble(figure))];
}

/// A count of trouble that is zero is dim: nothing to look at.
QVariant figureColour(const model::StreamFigures& figures, model::Figure figure) {
    if (const Health health = figureHealth(figures, figure); health != Health::Unknown) {
        return healthColour(health);
    }
    const bool isQuiet = model::rowOf(figure).trouble != model::FigureTrouble::None &&
                         figures.trouble(figure) == model::FigureTrouble::None;
    return isQuiet ? QVariant(theme().dim) : QVariant();
}

} // namespace

std::optional<model::Figure> figureIn(int column) {
    return kColumns[static_cast<std::size_t>(column)].figure;
}

StatisticsModel::StatisticsModel(model::SessionView& view)
    : StreamTreeModel(view, columns(*this)), m_losses(std::in_place, view, m_range) {}

std::vector<TableColumn<StreamRow>> StatisticsModel::columns(const StatisticsModel& model) {
    std::vector<TableColumn<StreamRow>> columns;
    for (int column = 0; column < kStatisticsColumns; ++column) {
        const auto figure = figureIn(column);
        columns.push_back(figure ? figureColumn(model, *figure) : curveColumn(model));
    }
    columns = withHelpInCells(std::move(columns));
    columns[kNameColumn] = {
        .title = tr("Stream"),
        .help =
            tr("Sender, character and message type; senders and characters are the sums of their streams"),
        .text = [&model](const StreamRow& row) { return model.nameOf(row); },
        .toolTip =
            [&model](const StreamRow& row) {
                return row.kind == Kind::Stream ? model.nameOf(row) : QString();
            },
        .more = [&model](const StreamRow& row, int role) { return model.marksOf(row, role); }};
    for (std::size_t column = 0; column < columns.size(); ++column) {
        const auto [figure, usual, order] = kColumns[column];
        columns[column].room = {.usual = QString::fromUtf8(usual), .order = order, .isOpen = column == 0};
    }
    return columns;
}

TableColumn<StreamRow> StatisticsModel::figureColumn(const StatisticsModel& model, model::Figure figure) {
    const model::FigureRow& about = model::rowOf(figure);
    const QString help =
        about.packets == nullptr
            ? translatedText(about.help)
            : tr("%1. Double click: %2").arg(translatedText(about.help), translatedText(about.packets));
    const auto value = [&model, figure](const StreamRow& row) {
        const model::StreamFigures& figures = model.figures(model.indexOf(row));
        return PropertyValue{figureText(figures, figure), figureHealth(figures, figure)};
    };
    const auto text = [value](const StreamRow& row) {
        const PropertyValue shown = value(row);
        return shown.text.isEmpty() ? shown.text : shown.display();
    };
    const auto spoken = [value](const StreamRow& row) {
        const PropertyValue shown = value(row);
        return shown.text.isEmpty() ? shown.text : shown.spoken();
    };
    const auto colour = [&model, figure](const StreamRow& row) {
        return figureColour(model.figures(model.indexOf(row)), figure);
    };
    return {.title = translatedText(about.shortTitle()),
            .help = help,
            .isNumber = true,
            .text = text,
            .colour = colour,
            .spoken = spoken};
}

TableColumn<StreamRow> StatisticsModel::curveColumn(const StatisticsModel& model) {
    const auto colour = [&model](const StreamRow& row) {
        const model::Stream* shown = model.stream(model.indexOf(row));
        return QVariant(shown == nullptr
                            ? theme().dim
                            : healthColour(streamState(model.view(), *model.m_losses, *shown).health));
    };
    const auto lists = [&model](const StreamRow& row, int role) {
        if (role != kSeriesRole && role != kMarksRole) {
            return QVariant();
        }
        const Curve& curve = model.curve(model.indexOf(row));
        return QVariant::fromValue(role == kSeriesRole ? curve.rates : curve.marks);
    };
    return {.title = tr("Curve"),
            .help = tr("Rate over the range, or over the last two minutes; marked where samples were lost"),
            .isNumber = true,
            .colour = colour,
            .more = lists};
}

void StatisticsModel::refresh() {
    const auto second = std::chrono::time_point_cast<std::chrono::seconds>(view().cursorStamp());
    const bool hasNewCurves = second != m_curveSecond || m_choice != view().choices().range;
    m_curveSecond = second;
    m_choice = view().choices().range;
    for (Cached& kept : m_cache) {
        kept.figures.reset();
        kept.curve = hasNewCurves ? std::nullopt : std::move(kept.curve);
    }
    m_range = view().range();
    m_losses.emplace(view(), m_range);
    if (insertNew()) {
        m_cache.clear();
    }
    announceChange();
}

StatisticsModel::Cached& StatisticsModel::cached(const QModelIndex& index) const {
    const auto place = static_cast<std::size_t>(index.internalId());
    m_cache.resize(std::max(m_cache.size(), place + 1));
    return m_cache[place];
}

const model::StreamFigures& StatisticsModel::figures(const QModelIndex& index) const {
    Cached& kept = cached(index);
    if (!kept.figures) {
        const model::Stream* shown = stream(index);
        kept.figures = shown != nullptr ? m_losses->figuresOf(*shown) : sumOf(index);
    }
    return *kept.figures;
}

model::StreamFigures StatisticsModel::sumOf(const QModelIndex& index) const {
    model::StreamFigures sum;
    const QModelIndex parent = index.siblingAtColumn(0); // only that has rows under it
    for (int row = 0; row < rowCount(parent); ++row) {
        sum.add(figures(this->index(row, 0, parent)));
    }
    if (rowOf(index).kind == Kind::Sender) {
        const model::Sender& sender = senderOf(rowOf(index)); // also those without a header
        sum.set(model::Figure::Malformed,
                static_cast<double>(m_range ? sender.history.malformedBetween(m_range->from, m_range->to)
                                            : sender.malformed));
    }
    return sum;
}

void StatisticsModel::addStreams(const QModelIndex& index, std::vector<const model::Stream*>& streams) const {
    if (const model::Stream* shown = stream(index)) {
        streams.push_back(shown);
    }
    const QModelIndex parent = index.siblingAtColumn(0);
    for (int row = 0; row < rowCount(parent); ++row) {
        addStreams(this->index(row, 0, parent), streams);
    }
}

const StatisticsModel::Curve& StatisticsModel::curve(const QModelIndex& index) const {
    Cached& kept = cached(index);
    if (!kept.curve) {
        kept.curve = makeCurve(index);
    }
    return *kept.curve;
}

StatisticsModel::Curve StatisticsModel::makeCurve(const QModelIndex& index) const {
    std::vector<const model::Stream*> streams = streamsOf(index);
    const bool isSum = stream(index) == nullptr;
    std::erase_if(streams, [](const auto* each) { return !model::countsSamples(each->key.type); });
    if (streams.empty()) {
        return {};
    }
    const log::Stamp end = view().cursorStamp();
    const model::TimeRange shown = m_range.value_or(model::TimeRange{end - kCurve, end});
    log::Stamp first = log::Stamp::max();
    log::Duration resolution(1);
    for (const model::Stream* each : streams) {
        first = std::min(first, each->accounting.firstStamp());
        resolution = std::max(resolution, each->accounting.resolution(shown.from));
    }
    const model::RangeParts parts = model::partsOf(shown, kCurvePoints, kLeastPart, resolution);
    std::array<model::RangePart, kCurvePoints> counted{};
    for (const model::Stream* each : streams) {
        m_losses->addParts(*each, parts, counted);
    }
    Curve made;
    const double seconds = log::secondsOf(parts.width);
    // Fewer parts than points are drawn as steps, so that the curve always fills its room.
    for (std::size_t point = 0; point < kCurvePoints && parts.count > 0; ++point) {
        const std::size_t part = point * parts.count / kCurvePoints;
        const bool isThere = parts.beginOf(part) >= first && parts.beginOf(part + 1) <= end;
        const double rate = (isSum ? counted[part].datagrams : counted[part].samples) / seconds;
        made.rates.append(isThere ? static_cast<float>(rate) : std::numeric_limits<float>::quiet_NaN());
        made.marks.append(static_cast<float>(counted[part].lost));
    }
    return made;
}

std::string StatisticsModel::csvLine(const model::Stream& stream) const {
    const model::StreamFigures figures = m_losses->figuresOf(stream);
    const model::CharacterKey key = characterOf(stream.key);
    const model::Sender* sender = view().roster().find(key.sender);
    std::vector<std::string> cells{
        sender == nullptr ? std::string() : sender->address().csv(), std::to_string(key.character),
        namesBeside(view()).roster().displayName(key).csv(), wire::typeDigits(stream.key.type)};
    for (const Column& column : kColumns) {
        if (column.figure) {
            cells.push_back(figureNumber(figures, *column.figure).toStdString());
        }
    }
    return exporting::csvLine(cells);
}

QString StatisticsModel::csv() const {
    std::vector<std::string> titles;
    for (const QString& title : {tr("Sender"), tr("Character"), tr("Name"), tr("Type")}) {
        titles.push_back(title.toStdString());
    }
    for (const Column& column : kColumns) {
        if (column.figure) {
            titles.push_back(translatedText(model::rowOf(*column.figure).title).toStdString());
        }
    }
    std::string text = exporting::csvLine(titles);
    for (const model::Stream* each : streamsOf({})) {
        text += csvLine(*each);
    }
    return QString::fromStdString(text);
}

void RangeOverview::refresh() {
    const auto whole = wholeSpan(m_view);
    if (m_view.roster().streams().empty() || !whole) {
        return;
    }
    using std::chrono::seconds;
    using std::chrono::time_point_cast;
    const bool isSameSecond = time_point_cast<seconds>(whole->to) == time_point_cast<seconds>(m_span.to);
    m_span = *whole;
    if (isSameSecond && !empty()) {
        return;
    }
    m_resolution = log::Duration(1);
    for (const model::Stream& stream : m_view.roster().streams()) {
        m_resolution = std::max(m_resolution, stream.accounting.resolution());
    }
    m_parts = model::partsOf(m_span, kMostParts, kLeastOverviewPart, m_resolution);
    m_counted.assign(m_parts.count, {});
    const model::Losses losses(m_view, {});
    for (const model::Stream& stream : m_view.roster().streams()) {
        losses.addParts(stream, m_parts, m_counted);
    }
}

} // namespace posewire::gui
