// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/statistics_model.h"

#include "app/gui/models/columns.h"
#include "app/gui/models/roles.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/stream_state.h"
#include "app/gui/models/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <limits>

namespace posewire::gui {

namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr double kMsPerNs = 1e-6;

constexpr std::array<ColumnText, StatisticsModel::kColumnCount> kColumns{{
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Stream"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Character and message type"), false},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Hz"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Samples a second as they arrive at this computer, not as they were sent")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "2 min"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Datagrams a second over the last two minutes")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Lost"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Samples that should have come, by the sender's own step, and of which nothing came")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Dev. ms"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Standard deviation of the time between samples over the newest 256 or 2 s")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Min. ms"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Least time between samples over the same window")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Mean ms"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Mean time between samples over the same window")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Max. ms"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Most time between samples over the same window")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "kB/s"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Thousands of payload bytes of UDP or TCP a second")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Datagrams"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Well-formed datagrams since the start")},
    {QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel", "Malformed"),
     QT_TRANSLATE_NOOP("posewire::gui::StatisticsModel",
                       "Datagrams that begin with MXTP and cannot be decoded")},
}};

} // namespace

StatisticsModel::StatisticsModel(model::SessionView& view, QObject* parent)
    : QAbstractTableModel(parent), m_view(view) {}

void StatisticsModel::refresh() {
    const int rows = static_cast<int>(m_view.streams().size());
    if (rows > m_rows) {
        beginInsertRows({}, m_rows, rows - 1);
        m_rows = rows;
        m_trends.resize(static_cast<std::size_t>(rows));
        endInsertRows();
    }
    addTrend();
    if (m_rows > 0) {
        emit dataChanged(index(0, 0), index(m_rows - 1, kColumnCount - 1));
    }
}

void StatisticsModel::addTrend() {
    const std::int64_t second = m_view.nowNs() / kNsPerSecond;
    const bool isFirst = !m_trendSecond.has_value();
    const std::int64_t passed = isFirst ? 0 : second - *m_trendSecond;
    if (!isFirst && passed == 0) {
        return;
    }
    m_trendSecond = second;
    for (std::size_t row = 0; row < m_trends.size(); ++row) {
        Trend& trend = m_trends[row];
        const std::uint64_t datagrams = stream(static_cast<int>(row)).accounting.datagrams();
        // A stream that has just appeared was there for a part of the second only.
        const bool isNew = trend.datagrams == 0;
        const std::uint64_t arrived = datagrams - std::exchange(trend.datagrams, datagrams);
        for (std::int64_t i = 1; i < std::min<std::int64_t>(passed, kTrendSeconds); ++i) {
            trend.rates.append(std::numeric_limits<float>::quiet_NaN());
        }
        if (passed == 1 && !isNew) {
            trend.rates.append(static_cast<float>(arrived));
        } else if (passed != 0) {
            trend.rates.append(std::numeric_limits<float>::quiet_NaN());
        }
        if (trend.rates.size() > kTrendSeconds) {
            trend.rates.remove(0, trend.rates.size() - kTrendSeconds);
        }
    }
}

const model::Stream& StatisticsModel::stream(int row) const {
    return m_view.streams()[static_cast<std::size_t>(row)];
}

int StatisticsModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : m_rows;
}

int StatisticsModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(kColumnCount);
}

QString StatisticsModel::text(const model::Stream& stream, int column) const {
    const model::StreamStatistics& figures = stream.statistics;
    switch (column) {
    case kStream:
        return characterName(m_view, {stream.key.source, stream.key.character});
    case kRate:
        return fixed(figures.rateHz(), 1);
    case kLost:
        return grouped(stream.accounting.counts().lost);
    case kDeviation:
        return fixed(figures.spacing().deviation * kMsPerNs, 2);
    case kLeast:
        return fixed(figures.spacing().least * kMsPerNs, 2);
    case kMean:
        return fixed(figures.spacing().mean * kMsPerNs, 2);
    case kMost:
        return fixed(figures.spacing().most * kMsPerNs, 2);
    case kBandwidth:
        return fixed(figures.bytesPerSecond() / 1000, 1);
    case kDatagrams:
        return grouped(stream.accounting.datagrams());
    case kMalformed:
        return grouped(stream.malformed);
    default:
        return {};
    }
}

Health StatisticsModel::health(const model::Stream& stream, int column) const {
    if (column == kLost && stream.accounting.counts().lost != 0) {
        return Health::Warning;
    }
    if (column == kMalformed && stream.malformed != 0) {
        return Health::Error;
    }
    return Health::Unknown;
}

QVariant StatisticsModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return {};
    }
    const model::Stream& shown = stream(index.row());
    const Health found = health(shown, index.column());
    switch (role) {
    case Qt::DisplayRole: {
        const QString value = text(shown, index.column());
        return found == Health::Unknown ? value : healthSymbol(found) + QLatin1Char(' ') + value;
    }
    case kSuffixRole: {
        const auto digits = wire::typeDigits(shown.key.type);
        return index.column() == kStream ? QVariant(QString::fromLatin1(digits.data(), 2)) : QVariant();
    }
    case kDotRole:
        return index.column() == kStream
                   ? QVariant(characterColour(m_view, {shown.key.source, shown.key.character}))
                   : QVariant();
    case kSeriesRole:
        return index.column() == kTrend && wire::isSampled(shown.key.type)
                   ? QVariant::fromValue(m_trends[static_cast<std::size_t>(index.row())].rates)
                   : QVariant();
    case Qt::ForegroundRole:
        if (index.column() == kTrend) {
            return healthColour(streamState(m_view, shown).health);
        }
        return found == Health::Unknown ? QVariant() : healthColour(found);
    case Qt::TextAlignmentRole:
        return index.column() == kStream ? QVariant() : numberAlignment();
    case Qt::ToolTipRole:
        return index.column() == kStream ? QString::fromStdString(wire::typeTitle(shown.key.type))
                                         : headerData(index.column(), Qt::Horizontal, role);
    default:
        return {};
    }
}

QVariant StatisticsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    return orientation == Qt::Horizontal
               ? columnHeader(kColumns, "posewire::gui::StatisticsModel", section, role)
               : QVariant();
}

} // namespace posewire::gui
