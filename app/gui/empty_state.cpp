// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/empty_state.h"

#include "app/gui/models/text.h"

#include <QCoreApplication>
#include <QNetworkInterface>

#include <algorithm>

namespace posewire::gui {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("EmptyState", text);
}

/// "47 45 54 20   GET ", of the first half: a line that fits.
QString bytesText(const std::string& hexadecimal) {
    constexpr qsizetype kShown = 8;
    const QByteArray data = QByteArray::fromHex(QByteArray::fromStdString(hexadecimal)).left(kShown);
    QString readable;
    for (const char byte : data) {
        readable += byte >= ' ' && byte <= '~' ? QLatin1Char(byte) : QLatin1Char('.');
    }
    return QString::fromLatin1(data.toHex(' ')) + QStringLiteral("   \"") + readable + QLatin1Char('"');
}

QString openPorts(const ReceivingState& receiving) {
    QStringList open;
    for (const PortState& state : receiving.ports) {
        if (state.problem.isEmpty()) {
            open += displayText(state.port);
        }
    }
    return open.join(tr(" and "));
}

EmptyState withoutPort(const ReceivingState& receiving) {
    EmptyState state;
    state.level = Health::Error;
    for (const PortState& port : receiving.ports) {
        state.title = tr("Cannot listen on %1").arg(displayText(port.port));
        state.lines += port.problem;
    }
    if (receiving.ports.empty()) {
        state.level = Health::Unknown;
        state.title = receiving.file.isEmpty() ? tr("Nothing to listen to")
                                               : tr("No character in %1").arg(receiving.file);
        state.lines += tr("Choose Source > Add UDP port, or File > Open.");
    }
    return state;
}

EmptyState foreign(const model::Source& source) {
    return {Health::Warning,
            tr("These datagrams are not MXTP"),
            {tr("%1 from %2, the newest begins with")
                 .arg(grouped(source.foreign), QString::fromStdString(source.info.address)),
             bytesText(source.firstForeignBytes),
             tr("MXTP datagrams begin with 4d 58 54 50, \"MXTP\". Something else uses this port.")}};
}

EmptyState withoutPose(const model::Session& session) {
    QStringList types;
    for (const model::Stream& stream : session.streams()) {
        const QString type = QStringLiteral("%1").arg(stream.key.type, 2, 10, QLatin1Char('0'));
        if (!types.contains(type)) {
            types += type;
        }
    }
    return {Health::Warning,
            tr("Datagrams arrive, but no pose"),
            {tr("Types on the air: %1.").arg(types.join(QStringLiteral(", "))),
             tr("In MVN's Network Streamer, switch on Position + Orientation (Quaternion).")}};
}

} // namespace

EmptyState emptyState(const model::Session& session, const ReceivingState& receiving,
                      const QStringList& addresses) {
    const bool hasPose = std::ranges::any_of(session.characters(), [&](const model::Character& character) {
        return session.pose(character.key) != nullptr;
    });
    if (hasPose) {
        return {};
    }
    if (!session.characters().empty()) {
        return withoutPose(session);
    }
    const auto stranger = std::ranges::find_if(session.sources(), [](const model::Source& source) {
        return source.foreign > 0 && !source.firstForeignBytes.empty();
    });
    if (stranger != session.sources().end()) {
        return foreign(*stranger);
    }
    const QString open = openPorts(receiving);
    if (open.isEmpty()) {
        return withoutPort(receiving);
    }
    const auto first =
        std::ranges::find_if(receiving.ports, [](const PortState& port) { return port.problem.isEmpty(); });
    EmptyState state{
        Health::Unknown,
        tr("Waiting for MXTP on %1").arg(open),
        {tr("In MVN: Options > Preferences > Network Streamer"),
         tr("host %1, port %2, protocol UDP").arg(addresses.join(tr(" or "))).arg(first->port.port)}};
    for (const PortState& port : receiving.ports) {
        if (!port.problem.isEmpty()) {
            state.lines += port.problem;
        }
    }
    return state;
}

QStringList reachableAddresses() {
    QStringList addresses;
    for (const QHostAddress& address : QNetworkInterface::allAddresses()) {
        if (address.protocol() == QAbstractSocket::IPv4Protocol && !address.isLoopback()) {
            addresses += address.toString();
        }
    }
    return addresses.isEmpty() ? QStringList{QStringLiteral("127.0.0.1")} : addresses;
}

} // namespace posewire::gui
