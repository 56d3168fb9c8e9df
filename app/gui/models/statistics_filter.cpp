// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/statistics_filter.h"

#include "core/filter/completion.h"
#include "core/wire/type_table.h"

#include <QCoreApplication>
#include <QStringList>

namespace posewire::gui {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("StatisticsFilter", text);
}

QString condition(const char* field, const std::string& value) {
    return QString::fromStdString(filter::expressionFor(field, value));
}

void addRow(model::SessionView& view, const StatisticsModel& model, const QModelIndex& index,
            QStringList& conditions) {
    const auto sender = model.sender(index);
    const auto character = model.character(index);
    const model::Sender* found = sender ? view.find(*sender) : nullptr;
    if (const model::Stream* stream = model.stream(index)) {
        conditions += condition("type", wire::typeDigits(stream->key.type));
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
    const auto seconds = [&view](log::Stamp stamp) {
        return QString::number(log::secondsOf(stamp - view.firstStamp()), 'f', 3);
    };
    return QStringLiteral("time >= %1 && time < %2").arg(seconds(range.from), seconds(range.to));
}

QString statisticsFilter(model::SessionView& view, const StatisticsModel& model, const QModelIndex& index) {
    QStringList conditions;
    addRow(view, model, index, conditions);
    const auto figure = figureIn(index.column());
    if (const char* trouble = figure ? model::rowOf(*figure).condition : nullptr) {
        conditions += QLatin1String(trouble);
    }
    if (model.range()) {
        conditions += rangeFilter(view, *model.range());
    }
    return conditions.join(QStringLiteral(" && "));
}

QString statisticsFilterTitle(int column) {
    const auto figure = figureIn(column);
    if (!figure) {
        return column == kNameColumn ? tr("All packets") : QString();
    }
    const char* title = model::rowOf(*figure).packets;
    return title == nullptr ? QString() : tr(title);
}

} // namespace posewire::gui
