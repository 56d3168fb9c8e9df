// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/statistics_filter.h"

#include "core/filter/expression_for.h"
#include "core/wire/type_table.h"

#include <QCoreApplication>
#include <QStringList>

namespace posewire::gui {

namespace {

using Column = StatisticsColumn;

QString tr(const char* text) {
    return QCoreApplication::translate("StatisticsFilter", text);
}

QString condition(const char* field, const std::string& value) {
    return QString::fromStdString(filter::expressionFor(field, value));
}

/// What packets have at which the column counts one.
const char* troubleCondition(Column column) {
    switch (column) {
    case Column::Lost:
    case Column::LossShare:
    case Column::LongestGap:
    case Column::Bursts:
    case Column::BurstLength:
    case Column::BurstDensity:
    case Column::GapDensity:
        return "gap > 0";
    case Column::Reordered:
    case Column::Late:
        return "reordered";
    case Column::Duplicates:
        return "duplicate";
    case Column::Restarts:
        return "restart";
    case Column::Malformed:
        return "malformed";
    default:
        return nullptr;
    }
}

void addRow(model::SessionView& view, const StatisticsModel& model, const QModelIndex& index,
            QStringList& conditions) {
    const auto sender = model.sender(index);
    const auto character = model.character(index);
    const model::Sender* found = sender ? view.find(*sender) : nullptr;
    if (const model::Stream* stream = model.stream(index)) {
        const auto digits = wire::typeDigits(stream->key.type);
        conditions += condition("type", std::string(digits.data(), 2));
    }
    if (character) {
        conditions += condition("character", std::to_string(character->character));
    }
    if (found != nullptr && (!character || view.senders().size() > 1)) {
        conditions += condition("source", found->info.address);
    }
}

} // namespace

QString rangeFilter(model::SessionView& view, const model::TimeRange& range) {
    const auto seconds = [&view](std::int64_t stampNs) {
        return QString::number(static_cast<double>(stampNs - view.firstStampNs()) * 1e-9, 'f', 3);
    };
    return QStringLiteral("time >= %1 && time < %2").arg(seconds(range.fromNs), seconds(range.toNs));
}

QString statisticsFilter(model::SessionView& view, const StatisticsModel& model, const QModelIndex& index) {
    QStringList conditions;
    addRow(view, model, index, conditions);
    if (const char* trouble = troubleCondition(static_cast<Column>(index.column()))) {
        conditions += QLatin1String(trouble);
    }
    if (model.range()) {
        conditions += rangeFilter(view, *model.range());
    }
    return conditions.join(QStringLiteral(" && "));
}

QString statisticsFilterTitle(StatisticsColumn column) {
    switch (column) {
    case Column::Stream:
        return tr("All packets");
    case Column::Lost:
        return tr("Packets after a gap");
    case Column::Duplicates:
        return tr("Duplicates");
    case Column::Reordered:
        return tr("Reordered packets");
    case Column::Restarts:
        return tr("Restarts");
    case Column::Malformed:
        return tr("Malformed packets");
    default:
        return {};
    }
}

} // namespace posewire::gui
