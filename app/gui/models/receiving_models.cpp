// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/receiving_models.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace posewire::gui {

namespace {

using Kind = InputAddress::Kind;
using InputColumn = TableColumn<PortState>;

QString protocolText(const InputAddress& input) {
    if (input.kind == Kind::Udp) {
        return input.groups.isEmpty() ? tr("UDP") : tr("UDP, multicast");
    }
    return input.kind == Kind::TcpListener ? tr("TCP, listening") : tr("TCP, connecting");
}

QString hostText(const InputAddress& input) {
    if (!input.groups.isEmpty()) {
        return input.groups.join(QStringLiteral(", "));
    }
    return input.address.isEmpty() ? tr("this computer") : input.address;
}

PropertyValue peersState(const net::InputStatus& status) {
    const std::vector<net::Peer>& peers = status.peers;
    QStringList lines;
    for (const net::Peer& peer : peers) {
        lines += tr("%1: %2 datagrams").arg(QString::fromStdString(peer.address), grouped(peer.datagrams));
    }
    const QString first = QString::fromStdString(peers.front().address);
    const QString text = peers.size() == 1
                             ? tr("connected from %1").arg(first)
                             : tr("connected from %1 and %2 more").arg(first).arg(peers.size() - 1);
    if (status.note.empty()) {
        return {text, Health::Good, lines.join(QLatin1Char('\n'))};
    }
    const QString note = QString::fromStdString(status.note);
    lines.prepend(note);
    return {text + QStringLiteral("; ") + note, Health::Warning, lines.join(QLatin1Char('\n'))};
}

/// Without words.
Advice adviceOf(words::Kind kind) {
    using Found = words::Kind;
    using Topic = HelpTopic;
    static const std::map<Found, Advice> kKnown{
        {Found::NoInput, {Health::Warning, {}, {}, Topic::NoInput}},
        {Found::CannotOpen, {Health::Error, {}, {}, Topic::CannotListen}},
        {Found::AddressGone, {Health::Error, {}, {}, Topic::NothingArrives, true}},
        {Found::ForeignDatagrams, {Health::Warning, {}, {}, Topic::NotMxtp}},
        {Found::GarbledPeer, {Health::Warning, {}, {}, Topic::NotMxtp, true}},
        {Found::NotJoined, {Health::Warning, {}, {}, Topic::GroupNotJoined}},
        {Found::NotReachable, {Health::Warning, {}, {}, Topic::TcpTrouble, true}},
        {Found::SilentPeer, {Health::Warning, {}, {}, Topic::TcpTrouble, true}},
        {Found::OtherTransport, {Health::Unknown, {}, {}, Topic::NothingArrives}},
        {Found::FirewallOn, {Health::Unknown, {}, {}, Topic::NothingArrives}},
    };
    const auto known = kKnown.find(kind);
    return known == kKnown.end() ? Advice{Health::Warning, {}, {}, Topic::NothingArrives} : known->second;
}

/// MVN's Isaac Teleop preset has a port of its own; other senders may use the other transport.
std::optional<InputAddress> offerFor(words::Kind kind, const std::vector<PortState>& ports) {
    using Found = words::Kind;
    constexpr std::uint16_t kTeleopPort = 9764;
    const bool isTransport =
        kind == Found::TcpKnocked || kind == Found::TcpRefused || kind == Found::OtherTransport;
    if (ports.empty() || (!isTransport && kind != Found::NoListener)) {
        return std::nullopt;
    }
    InputAddress offer = ports.front().port;
    offer.groups.clear();
    if (isTransport) {
        offer.kind = offer.kind == Kind::Udp ? Kind::TcpListener : Kind::Udp;
    } else {
        offer.port = kTeleopPort;
    }
    const bool isOpen = std::ranges::find(ports, offer, &PortState::port) != ports.end();
    return isOpen ? std::nullopt : std::optional(offer);
}

/// A figure of an input that is open.
InputColumn figureColumn(const QString& title, const QString& help, QString (*figure)(const PortState&)) {
    return InputColumn::numbers(
               title, help, [figure](const PortState& input) { return input.id ? figure(input) : dash(); })
        .in({QStringLiteral("100 000")});
}

InputColumn hostColumn() {
    const auto suffix = [](const PortState& input, int role) {
        const bool isEvery = input.port.address.isEmpty() && input.port.groups.isEmpty();
        return role == kSuffixRole && isEvery ? QVariant(tr("· every address")) : QVariant();
    };
    return InputColumn::words(tr("Host"), tr("Where it is heard; for a connection to a sender, that sender"),
                              [](const PortState& input) { return hostText(input.port); })
        .in({tr("this computer · every address")})
        .withMore(suffix);
}

std::vector<InputColumn> inputColumns() {
    return {
        InputColumn::words(tr("Protocol"), {},
                           [](const PortState& input) { return protocolText(input.port); })
            .in({tr("TCP, connecting")}),
        hostColumn(),
        InputColumn::numbers(tr("Port"), {},
                             [](const PortState& input) { return QString::number(input.port.port); })
            .in({QStringLiteral("65535")}),
        valueColumn(InputColumn{.title = tr("State"),
                                .room = {.usual = tr("listening, nobody has connected"), .isOpen = true}},
                    inputState),
        figureColumn(tr("Datagrams/s"), tr("Over the last second, foreign ones included"),
                     [](const PortState& input) {
                         return grouped(static_cast<std::uint64_t>(std::lround(input.datagramsPerSecond)));
                     }),
        figureColumn(tr("Datagrams"), tr("Since it was opened, foreign ones included"),
                     [](const PortState& input) { return grouped(input.status.datagrams); })
            .in({QStringLiteral("100 000 000")}),
        figureColumn(tr("Dropped here"),
                     tr("Datagrams that reached this computer and found its receive buffer full; TCP makes "
                        "the sender wait instead"),
                     [](const PortState& input) {
                         return input.port.kind == Kind::Udp
                                    ? droppedText(input.status.kernelDropped, net::kCountsDrops)
                                    : dash();
                     })
            .withColour([](const PortState& input) {
                return input.status.kernelDropped > 0 ? QVariant(theme().error) : QVariant();
            }),
        figureColumn(tr("Refused"),
                     tr("Datagrams and connections from those who are not listened to, and connections for "
                        "which there was no room"),
                     [](const PortState& input) {
                         return grouped(input.status.refusedDatagrams + input.status.refusedPeers);
                     }),
    };
}

using WayOutColumn = TableColumn<WayOutState>;

WayOutColumn wayOutCount(const QString& title, const QString& help, std::uint64_t WayOutState::*count) {
    return WayOutColumn::numbers(title, help, [count](const auto& way) { return grouped(way.*count); })
        .in({QStringLiteral("100 000")});
}

WayOutColumn troubleColumn(const QString& title, const QString& help, std::uint64_t WayOutState::*count) {
    return wayOutCount(title, help, count).withColour([count](const WayOutState& way) {
        return way.*count > 0 ? QVariant(theme().warning) : QVariant();
    });
}

std::vector<WayOutColumn> waysOutColumns() {
    const auto box = [](const WayOutState& way, int role) {
        return role == Qt::CheckStateRole ? QVariant(way.target.isOn ? Qt::Checked : Qt::Unchecked)
                                          : QVariant();
    };
    return {
        WayOutColumn::words(tr("To"), {}, [](const auto& way) { return displayText(way.target); })
            .in({QStringLiteral("☑ motion-capture.studio:65535")})
            .withMore(box),
        WayOutColumn::words(tr("As"), tr("The form in which it is handed on"),
                            [](const auto& way) {
                                const QString form = translatedText(way.form);
                                return way.target.character.isEmpty()
                                           ? form
                                           : tr("%1 of %2").arg(form, way.target.character);
                            })
            .in({QStringLiteral("Datagrams")}),
        valueColumn(
            WayOutColumn{.title = tr("State"), .room = {.usual = tr("looking up studio"), .isOpen = true}},
            wayOutStage),
        wayOutCount(tr("Sent"), tr("Datagrams, or lines to each who has connected"), &WayOutState::sent)
            .in({QStringLiteral("100 000 000")}),
        troubleColumn(
            tr("Refused"),
            tr("Datagrams that this system did not take (no way there, or too long for UDP), or that "
               "the other computer sent back because nobody listens there"),
            &WayOutState::refused),
        troubleColumn(tr("Skipped"),
                      tr("Datagrams left out because forwarding had fallen too far behind, or while it was "
                         "found out whether they come back; lines that a program had no room for"),
                      &WayOutState::skipped),
        wayOutCount(tr("Behind"), tr("Packets received that wait to be forwarded"), &WayOutState::behind),
    };
}

} // namespace

PropertyValue inputState(const PortState& state) {
    if (!state.problem.isEmpty()) {
        return {state.problem, state.id ? Health::Warning : Health::Error, state.problem};
    }
    const net::InputStatus& status = state.status;
    if (!status.problem.empty()) {
        const QString problem = QString::fromStdString(status.problem);
        return {problem, Health::Warning, problem};
    }
    if (!status.peers.empty() && state.port.kind == Kind::TcpListener) {
        return peersState(status);
    }
    if (status.state == net::InputState::Connected) {
        return {QString::fromStdString(status.text), Health::Good};
    }
    if (state.port.kind == Kind::Udp && state.datagramsPerSecond > 0) {
        return {tr("receiving"), Health::Good,
                state.port.groups.isEmpty() ? QString() : QString::fromStdString(status.text)};
    }
    const bool saysMore = !state.port.groups.isEmpty() || !status.note.empty();
    if (status.state == net::InputState::Connecting || saysMore) {
        return {QString::fromStdString(status.text)};
    }
    return {state.port.kind == Kind::TcpListener ? tr("listening, nobody has connected") : tr("listening")};
}

PropertyValue wayOutStage(const WayOutState& way) {
    switch (way.stage) {
    case WayOutState::Stage::LookingUp:
        return {tr("looking up %1").arg(displayText(way.target))};
    case WayOutState::Stage::Refused:
        return {way.problem, Health::Error, way.problem};
    case WayOutState::Stage::Forwarding:
        return !way.problem.isEmpty()       ? PropertyValue{way.problem, Health::Warning, way.problem}
               : !way.target.host.isEmpty() ? PropertyValue{tr("forwarding"), Health::Good}
               : way.receivers == 0
                   ? PropertyValue{tr("no program connected")}
                   : PropertyValue{tr("%n connected", nullptr, static_cast<int>(way.receivers)),
                                   Health::Good};
    case WayOutState::Stage::Off:
        break;
    }
    return {tr("off")};
}

std::vector<Advice> adviceOn(const ReceivingState& receiving) {
    std::vector<Advice> all;
    for (const words::Fact& finding : receiving.findings) {
        all.push_back(adviceOf(finding.kind));
        all.back().text = said(finding, words::Form::Sentence);
        all.back().remedy = said(finding, words::Form::Advice);
        all.back().offer = offerFor(finding.kind, receiving.ports);
    }
    return all;
}

InputModel::InputModel() : TableModel(inputColumns()) {}

std::optional<InputAddress> InputModel::input(int row) const {
    return row >= 0 && row < rowCount() ? std::optional(rows()[static_cast<std::size_t>(row)].port)
                                        : std::nullopt;
}

int InputModel::rowOf(const InputAddress& input) const {
    const auto place = std::ranges::find(rows(), input, &PortState::port);
    return place == rows().end() ? -1 : static_cast<int>(place - rows().begin());
}

WaysOutModel::WaysOutModel() : TableModel(waysOutColumns()) {}

bool WaysOutModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (role != Qt::CheckStateRole || index.column() != kTarget ||
        !checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return false;
    }
    emit switched(index.row(), value.toInt() == Qt::Checked);
    return true;
}

Qt::ItemFlags WaysOutModel::flags(const QModelIndex& index) const {
    const Qt::ItemFlags flags = TableModel::flags(index);
    return index.column() == kTarget ? flags | Qt::ItemIsUserCheckable : flags;
}

} // namespace posewire::gui
