// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/statistics_model.h"

#include "app/gui/models/columns.h"
#include "app/gui/models/roles.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/stream_state.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <limits>

namespace posewire::gui {

namespace {

/// Shorter parts show the beat of samples and buckets, not the rate.
constexpr log::Duration kLeastPart = std::chrono::milliseconds(500);

} // namespace

StatisticsModel::StatisticsModel(model::SessionView& view, QObject* parent)
    : StreamTreeModel(view, {}, parent) {}

void StatisticsModel::refresh() {
    ++m_turn;
    const auto second = std::chrono::time_point_cast<std::chrono::seconds>(view().cursorStamp());
    if (second != m_curveSecond || m_choice != view().rangeChoice()) {
        m_curveSecond = second;
        m_choice = view().rangeChoice();
        ++m_curveTurn;
    }
    m_range = view().range();
    insertNew();
    announceChange();
}

StatisticsModel::Cached& StatisticsModel::cached(const QModelIndex& index) const {
    const auto node = static_cast<std::size_t>(index.internalId());
    if (node >= m_cache.size()) {
        m_cache.resize(node + 1);
    }
    return m_cache[node];
}

const model::StreamFigures& StatisticsModel::figures(const QModelIndex& index) const {
    if (cached(index).turn != m_turn) {
        const model::Stream* shown = stream(index);
        const auto made = shown != nullptr ? model::figuresOf(*shown, m_range) : sumOf(index);
        cached(index).figures = made; // sums fill the cache of others: look again
        cached(index).turn = m_turn;
    }
    return cached(index).figures;
}

model::StreamFigures StatisticsModel::sumOf(const QModelIndex& index) const {
    model::StreamFigures sum;
    const QModelIndex parent = index.siblingAtColumn(0); // only that has rows under it
    for (int row = 0; row < rowCount(parent); ++row) {
        sum.add(figures(this->index(row, 0, parent)));
    }
    if (nodeOf(index).kind == Kind::Sender) {
        const model::Sender& sender = view().senders()[nodeOf(index).entry]; // also those without a header
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
    if (kept.curveTurn != m_curveTurn) {
        kept.curve = makeCurve(index);
        kept.curveTurn = m_curveTurn;
    }
    return kept.curve;
}

StatisticsModel::Curve StatisticsModel::makeCurve(const QModelIndex& index) const {
    std::vector<const model::Stream*> streams;
    addStreams(index, streams);
    const bool isSum = stream(index) == nullptr;
    std::erase_if(streams, [](const auto* each) { return !model::countsSamples(each->key.type); });
    if (streams.empty()) {
        return {};
    }
    log::Stamp first = log::Stamp::max();
    log::Duration resolution(1);
    for (const model::Stream* each : streams) {
        first = std::min(first, each->accounting.firstStamp());
        resolution = std::max(resolution, each->accounting.resolution());
    }
    const log::Stamp end = view().cursorStamp();
    const model::TimeRange shown = m_range.value_or(model::TimeRange{end - kCurve, end});
    const model::RangeParts parts = model::partsOf(shown, kCurvePoints, kLeastPart, resolution);
    std::array<model::RangePart, kCurvePoints> counted{};
    for (const model::Stream* each : streams) {
        model::addParts(each->accounting, parts, counted);
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

int StatisticsModel::columnCount(const QModelIndex&) const {
    return kStatisticsColumns;
}

QVariant StatisticsModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return {};
    }
    if (figureIn(index.column())) {
        return figureData(index, role);
    }
    return index.column() == kNameColumn ? nameData(index, role) : curveData(index, role);
}

QVariant StatisticsModel::nameData(const QModelIndex& index, int role) const {
    if (const model::Stream* shown = stream(index)) {
        const QString title = QString::fromStdString(wire::typeTitle(shown->key.type));
        return role == Qt::DisplayRole || role == Qt::ToolTipRole ? title : QVariant();
    }
    const auto key = character(index);
    if (!key) {
        const model::Sender& shown = view().senders()[nodeOf(index).entry];
        return role == Qt::DisplayRole ? QString::fromStdString(shown.info.address) : QVariant();
    }
    switch (role) {
    case Qt::DisplayRole:
        return characterName(view(), *key);
    case kSuffixRole:
        return QStringLiteral("· %1").arg(key->character);
    case kDotRole:
        return characterColour(view(), *key);
    default:
        return {};
    }
}

QVariant StatisticsModel::curveData(const QModelIndex& index, int role) const {
    switch (role) {
    case kSeriesRole:
        return QVariant::fromValue(curve(index).rates);
    case kMarksRole:
        return QVariant::fromValue(curve(index).marks);
    case Qt::ForegroundRole:
        if (const model::Stream* shown = stream(index)) {
            return healthColour(streamState(view(), *shown).health);
        }
        return theme().dim;
    case Qt::ToolTipRole:
        return headerData(index.column(), Qt::Horizontal, role);
    default:
        return role == Qt::TextAlignmentRole ? numberAlignment() : QVariant();
    }
}

QVariant StatisticsModel::figureData(const QModelIndex& index, int role) const {
    const model::Figure figure = *figureIn(index.column());
    const Health health = statisticsHealth(figures(index), figure);
    switch (role) {
    case Qt::DisplayRole: {
        const QString text = statisticsText(figures(index), figure);
        return health == Health::Unknown || text.isEmpty() ? text
                                                           : healthSymbol(health) + QLatin1Char(' ') + text;
    }
    case Qt::ForegroundRole:
        if (health == Health::Unknown) {
            return isQuiet(figures(index), figure) ? QVariant(theme().dim) : QVariant();
        }
        return healthColour(health);
    case Qt::TextAlignmentRole:
        return numberAlignment();
    case Qt::ToolTipRole:
        return headerData(index.column(), Qt::Horizontal, role);
    default:
        return {};
    }
}

QVariant StatisticsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    return orientation == Qt::Horizontal ? statisticsHeader(section, role) : QVariant();
}

} // namespace posewire::gui
