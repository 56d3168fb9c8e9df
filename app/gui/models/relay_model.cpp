// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/relay_model.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

namespace posewire::gui {

namespace {

using RelayColumn = TableColumn<RelayState>;

QVariant checkBox(const RelayState& relay, int role) {
    return role == Qt::CheckStateRole ? QVariant(relay.target.isOn ? Qt::Checked : Qt::Unchecked)
                                      : QVariant();
}

RelayColumn countColumn(const QString& title, const QString& help, std::uint64_t RelayState::*count,
                        bool isTrouble) {
    return {.title = title,
            .help = help,
            .isNumber = true,
            .text = [count](const RelayState& relay) { return grouped(relay.*count); },
            .colour =
                [count, isTrouble](const RelayState& relay) {
                    return isTrouble && relay.*count > 0 ? QVariant(theme().warning) : QVariant();
                },
            .sortKey = [count](const RelayState& relay) { return QVariant::fromValue(relay.*count); }};
}

std::vector<RelayColumn> relayColumns() {
    return {
        {.title = tr("Host"),
         .text = [](const RelayState& relay) { return relay.target.host; },
         .more = checkBox},
        {.title = tr("Port"),
         .isNumber = true,
         .text = [](const RelayState& relay) { return QString::number(relay.target.port); },
         .sortKey = [](const RelayState& relay) { return QVariant(int{relay.target.port}); }},
        valueColumn(RelayColumn{.title = tr("State")}, relayStage),
        countColumn(tr("Sent"), tr("Datagrams forwarded"), &RelayState::sent, false),
        countColumn(tr("Refused"),
                    tr("Datagrams that this system did not take: no way there, or too long for UDP"),
                    &RelayState::refused, true),
        countColumn(tr("Skipped"), tr("Datagrams left out because forwarding had fallen too far behind"),
                    &RelayState::skipped, true),
    };
}

} // namespace

RelayModel::RelayModel(QObject* parent) : TableModel(relayColumns(), parent) {}

PropertyValue relayStage(const RelayState& relay) {
    switch (relay.stage) {
    case RelayState::Stage::LookingUp:
        return {tr("looking up %1").arg(relay.target.host)};
    case RelayState::Stage::Refused:
        return {relay.problem, Health::Error, relay.problem};
    case RelayState::Stage::Forwarding:
        return relay.problem.isEmpty() ? PropertyValue{tr("forwarding"), Health::Good}
                                       : PropertyValue{relay.problem, Health::Warning, relay.problem};
    case RelayState::Stage::Off:
        break;
    }
    return {tr("off")};
}

bool RelayModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (role != Qt::CheckStateRole || index.column() != kHost ||
        !checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return false;
    }
    emit switched(index.row(), value.toInt() == Qt::Checked);
    return true;
}

Qt::ItemFlags RelayModel::flags(const QModelIndex& index) const {
    const Qt::ItemFlags flags = TableModel::flags(index);
    return index.column() == kHost ? flags | Qt::ItemIsUserCheckable : flags;
}

} // namespace posewire::gui
