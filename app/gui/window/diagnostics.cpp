// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/diagnostics.h"

#include "app/gui/models/receiving_models.h"
#include "app/gui/models/text.h"
#include "core/model/session/roster.h"
#include "core/words/say.h"

#include <QGuiApplication>
#include <QSysInfo>
#include <QTextStream>

namespace posewire::gui {

namespace {

void writeReceiving(QTextStream& out, const ReceivingState& receiving) {
    for (const PortState& port : receiving.ports) {
        out << displayText(port.port) << ": " << inputState(port).text << ", " << port.status.datagrams
            << " datagrams, " << droppedText(port.status.kernelDropped, net::kCountsDrops)
            << " dropped here, " << port.status.refusedDatagrams << " refused\n";
    }
    for (const WayOutState& way : receiving.waysOut) {
        out << way.target.kind << " to " << displayText(way.target) << ": " << wayOutStage(way).text << ", "
            << way.sent << " sent, " << way.refused << " refused, " << way.skipped << " skipped, "
            << way.behind << " behind\n";
    }
    for (const words::Fact& finding : receiving.findings) {
        out << "found: " << QString::fromStdString(words::say(finding, words::Form::Sentence)) << '\n';
    }
    out << "receive buffer " << receiving.receiveBufferBytes << " bytes, dropped here "
        << droppedText(receiving.kernelDropped, net::kCountsDrops) << ", " << receiving.datagramsPerSecond
        << " datagrams/s, " << receiving.bytesPerSecond << " bytes/s\n";
}

void writeSenders(QTextStream& out, model::SessionView& session) {
    for (const model::Sender& sender : session.roster().senders()) {
        out << "sender " << shown(sender.address()) << ": " << sender.datagrams << " datagrams, "
            << sender.malformed << " malformed, " << sender.foreign << " foreign, " << sender.skippedBytes
            << " bytes skipped\n";
    }
    for (const model::Stream& stream : session.roster().streams()) {
        const model::CharacterKey key{stream.key.sender, stream.key.character};
        out << "stream " << shown(session.roster().displayName(key)) << " type " << stream.key.type << ": "
            << stream.accounting.datagrams() << " datagrams, " << stream.statistics.rateHz() << " Hz, "
            << stream.accounting.counts().lost << " lost, " << stream.accounting.malformed()
            << " malformed\n";
    }
}

} // namespace

QString diagnosticsText(model::SessionView& session, const ReceivingState& receiving,
                        const QString& rendererName) {
    QString text;
    QTextStream out(&text);
    out << "Posewire " << QCoreApplication::applicationVersion() << ", Qt " << qVersion() << ", "
        << QSysInfo::prettyProductName() << ", " << QSysInfo::currentCpuArchitecture() << ", platform "
        << QGuiApplication::platformName() << '\n';
    out << "OpenGL: " << (rendererName.isEmpty() ? QStringLiteral("none") : rendererName) << '\n';
    writeReceiving(out, receiving);
    const log::LogFigures figures = session.log().figures();
    out << "history: packets " << figures.begin << " to " << figures.end << ", " << figures.memoryInUse
        << " of " << figures.memoryCap << " bytes\n";
    writeSenders(out, session);
    return text;
}

} // namespace posewire::gui
