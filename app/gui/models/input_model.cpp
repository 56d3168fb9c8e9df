// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/input_model.h"

#include "app/gui/models/columns.h"
#include "app/gui/models/roles.h"
#include "app/gui/models/text.h"

#include <algorithm>

namespace posewire::gui {

namespace {

using Kind = InputAddress::Kind;

constexpr const char* kContext = "InputModel";

const ColumnText kColumns[] = {
    {QT_TRANSLATE_NOOP("InputModel", "Protocol"), "", false},
    {QT_TRANSLATE_NOOP("InputModel", "Host"),
     QT_TRANSLATE_NOOP("InputModel", "Where it is heard; for a connection to a sender, that sender"), false},
    {QT_TRANSLATE_NOOP("InputModel", "Port"), ""},
    {QT_TRANSLATE_NOOP("InputModel", "State"), "", false},
    {QT_TRANSLATE_NOOP("InputModel", "Datagrams/s"),
     QT_TRANSLATE_NOOP("InputModel", "Over the last second, foreign ones included")},
    {QT_TRANSLATE_NOOP("InputModel", "Datagrams"),
     QT_TRANSLATE_NOOP("InputModel", "Since it was opened, foreign ones included")},
    {QT_TRANSLATE_NOOP("InputModel", "Dropped here"),
     QT_TRANSLATE_NOOP("InputModel",
                       "Datagrams that reached this computer and found its receive buffer full; TCP makes "
                       "the sender wait instead")},
};

QString protocolText(const InputAddress& input) {
    switch (input.kind) {
    case Kind::Udp:
        return input.groups.isEmpty() ? InputModel::tr("UDP") : InputModel::tr("UDP, multicast");
    case Kind::TcpListen:
        return InputModel::tr("TCP, listening");
    case Kind::TcpConnect:
        break;
    }
    return InputModel::tr("TCP, connecting");
}

QString hostText(const InputAddress& input) {
    if (!input.groups.isEmpty()) {
        return input.groups.join(QStringLiteral(", "));
    }
    return input.address.isEmpty() ? InputModel::tr("this computer") : input.address;
}

PropertyValue peersState(const std::vector<net::Peer>& peers) {
    QStringList lines;
    for (const net::Peer& peer : peers) {
        lines += InputModel::tr("%1: %2 datagrams")
                     .arg(QString::fromStdString(peer.address), grouped(peer.datagrams));
    }
    const QString first = QString::fromStdString(peers.front().address);
    const QString text =
        peers.size() == 1 ? InputModel::tr("connected from %1").arg(first)
                          : InputModel::tr("connected from %1 and %2 more").arg(first).arg(peers.size() - 1);
    return {text, Health::Good, lines.join(QLatin1Char('\n'))};
}

} // namespace

PropertyValue inputState(const PortState& state) {
    if (!state.problem.isEmpty()) {
        return {state.problem, state.id ? Health::Warning : Health::Error, state.problem};
    }
    const net::InputStatus& status = state.status;
    if (!status.peers.empty() && state.port.kind == Kind::TcpListen) {
        return peersState(status.peers);
    }
    const bool isReceiving = state.port.kind == Kind::Udp && state.datagramsPerSecond > 0;
    if (status.state == net::InputState::Connected || isReceiving) {
        const QString text = status.state == net::InputState::Connected ? QString::fromStdString(status.text)
                                                                        : InputModel::tr("receiving");
        return {text, Health::Good, {}};
    }
    if (status.state == net::InputState::Connecting) {
        return {QString::fromStdString(status.text), Health::Unknown, {}};
    }
    return {state.port.kind == Kind::TcpListen ? InputModel::tr("listening, nobody has connected")
                                               : InputModel::tr("listening"),
            Health::Unknown,
            {}};
}

void InputModel::refresh(const ReceivingState& receiving) {
    fitRows(receiving.ports.size() + (receiving.file.isEmpty() ? 0 : 1));
    std::ranges::transform(receiving.ports, m_rows.begin(), [](const PortState& state) {
        return Row{state, {}};
    });
    if (!receiving.file.isEmpty()) {
        m_rows.back() = {{}, receiving.file};
    }
    if (!m_rows.empty()) {
        emit dataChanged(index(0, 0), index(rowCount() - 1, kColumnCount - 1));
    }
}

void InputModel::fitRows(std::size_t count) {
    const std::size_t rows = m_rows.size();
    if (count > rows) {
        beginInsertRows({}, static_cast<int>(rows), static_cast<int>(count) - 1);
        m_rows.resize(count);
        endInsertRows();
    } else if (count < rows) {
        beginRemoveRows({}, static_cast<int>(count), static_cast<int>(rows) - 1);
        m_rows.resize(count);
        endRemoveRows();
    }
}

std::optional<InputAddress> InputModel::input(int row) const {
    const bool isRow = row >= 0 && static_cast<std::size_t>(row) < m_rows.size();
    return isRow && m_rows[static_cast<std::size_t>(row)].file.isEmpty()
               ? std::optional(m_rows[static_cast<std::size_t>(row)].input.port)
               : std::nullopt;
}

int InputModel::rowOf(const InputAddress& input) const {
    const auto place = std::ranges::find_if(
        m_rows, [&](const Row& row) { return row.file.isEmpty() && row.input.port == input; });
    return place == m_rows.end() ? -1 : static_cast<int>(place - m_rows.begin());
}

int InputModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int InputModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int{kColumnCount};
}

QVariant InputModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return {};
    }
    if (role == Qt::TextAlignmentRole) {
        return kColumns[index.column()].isNumber ? numberAlignment() : QVariant();
    }
    const Row& row = m_rows[static_cast<std::size_t>(index.row())];
    if (!row.file.isEmpty()) {
        return fileData(row.file, index.column(), role);
    }
    const PortState& state = row.input;
    if (index.column() == kState) {
        const PropertyValue value = inputState(state);
        return role == Qt::DisplayRole      ? QVariant(value.display())
               : role == Qt::ForegroundRole ? value.colour()
               : role == Qt::ToolTipRole    ? QVariant(value.toolTip)
                                            : QVariant();
    }
    if (role == Qt::ForegroundRole && index.column() == kDropped && state.status.kernelDropped > 0) {
        return theme().error;
    }
    if (role == kSuffixRole && index.column() == kHost && state.port.address.isEmpty() &&
        state.port.groups.isEmpty()) {
        return tr("· every address");
    }
    return role == Qt::DisplayRole ? QVariant(text(state, index.column())) : QVariant();
}

QString InputModel::text(const PortState& state, int column) {
    switch (column) {
    case kProtocol:
        return protocolText(state.port);
    case kHost:
        return hostText(state.port);
    case kPort:
        return QString::number(state.port.port);
    case kRate:
        return state.id ? fixed(state.datagramsPerSecond, 0) : QStringLiteral("–");
    case kDatagrams:
        return state.id ? grouped(state.status.datagrams) : QStringLiteral("–");
    default:
        return state.id && state.port.kind == Kind::Udp ? grouped(state.status.kernelDropped)
                                                        : QStringLiteral("–");
    }
}

QVariant InputModel::fileData(const QString& file, int column, int role) {
    if (role != Qt::DisplayRole) {
        return {};
    }
    switch (column) {
    case kProtocol:
        return tr("File");
    case kHost:
        return file;
    case kState:
        return tr("opened");
    default:
        return QStringLiteral("–");
    }
}

QVariant InputModel::headerData(int section, Qt::Orientation orientation, int role) const {
    return orientation == Qt::Horizontal ? columnHeader(kColumns, kContext, section, role) : QVariant();
}

} // namespace posewire::gui
