// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/relay_model.h"

#include "app/gui/models/columns.h"
#include "app/gui/models/text.h"

namespace posewire::gui {

namespace {

constexpr const char* kContext = "RelayModel";

const ColumnText kColumns[] = {
    {QT_TRANSLATE_NOOP("RelayModel", "Host"), "", false},
    {QT_TRANSLATE_NOOP("RelayModel", "Port"), ""},
    {QT_TRANSLATE_NOOP("RelayModel", "State"), "", false},
    {QT_TRANSLATE_NOOP("RelayModel", "Sent"), QT_TRANSLATE_NOOP("RelayModel", "Datagrams forwarded")},
    {QT_TRANSLATE_NOOP("RelayModel", "Refused"),
     QT_TRANSLATE_NOOP("RelayModel",
                       "Datagrams that this system did not take: no way there, or too long for UDP")},
    {QT_TRANSLATE_NOOP("RelayModel", "Skipped"),
     QT_TRANSLATE_NOOP("RelayModel", "Datagrams left out because forwarding had fallen too far behind")},
};

} // namespace

PropertyValue relayStage(const RelayState& relay) {
    switch (relay.stage) {
    case RelayState::Stage::LookingUp:
        return {RelayModel::tr("looking up %1").arg(relay.target.host), Health::Unknown, {}};
    case RelayState::Stage::Refused:
        return {relay.problem, Health::Error, relay.problem};
    case RelayState::Stage::Forwarding:
        return relay.problem.isEmpty() ? PropertyValue{RelayModel::tr("forwarding"), Health::Good, {}}
                                       : PropertyValue{relay.problem, Health::Warning, relay.problem};
    case RelayState::Stage::Off:
        break;
    }
    return {RelayModel::tr("off"), Health::Unknown, {}};
}

void RelayModel::refresh(const std::vector<RelayState>& relays) {
    const int before = rowCount();
    const int after = static_cast<int>(relays.size());
    if (after > before) {
        beginInsertRows({}, before, after - 1);
        m_relays = relays;
        endInsertRows();
    } else if (after < before) {
        beginRemoveRows({}, after, before - 1);
        m_relays = relays;
        endRemoveRows();
    } else {
        m_relays = relays;
    }
    if (after > 0) {
        emit dataChanged(index(0, 0), index(after - 1, kColumnCount - 1));
    }
}

int RelayModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(m_relays.size());
}

int RelayModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int{kColumnCount};
}

QVariant RelayModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return {};
    }
    const RelayState& relay = m_relays[static_cast<std::size_t>(index.row())];
    const int column = index.column();
    if (role == Qt::TextAlignmentRole) {
        return kColumns[column].isNumber ? numberAlignment() : QVariant();
    }
    if (role == Qt::CheckStateRole && column == kHost) {
        return relay.target.isOn ? Qt::Checked : Qt::Unchecked;
    }
    if (role == Qt::DisplayRole) {
        return text(relay, column);
    }
    const PropertyValue stage = relayStage(relay);
    if (column == kState && role == Qt::ToolTipRole) {
        return stage.toolTip;
    }
    if (role != Qt::ForegroundRole) {
        return {};
    }
    const bool isCounted =
        (column == kRefused && relay.refused > 0) || (column == kSkipped && relay.skipped > 0);
    return column == kState ? stage.colour() : isCounted ? QVariant(theme().warning) : QVariant();
}

QString RelayModel::text(const RelayState& relay, int column) {
    switch (column) {
    case kHost:
        return relay.target.host;
    case kPort:
        return QString::number(relay.target.port);
    case kState:
        return relayStage(relay).display();
    case kSent:
        return grouped(relay.sent);
    case kRefused:
        return grouped(relay.refused);
    default:
        return grouped(relay.skipped);
    }
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
    const Qt::ItemFlags flags = QAbstractTableModel::flags(index);
    return index.column() == kHost ? flags | Qt::ItemIsUserCheckable : flags;
}

QVariant RelayModel::headerData(int section, Qt::Orientation orientation, int role) const {
    return orientation == Qt::Horizontal ? columnHeader(kColumns, kContext, section, role) : QVariant();
}

} // namespace posewire::gui
