// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/texts.h"

#include "app/gui/models/receiving_models.h"
#include "app/gui/models/statistics_model.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/icons.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "app/gui/window/menus.h"
#include "core/export/protocol_reference.h"
#include "core/model/session/roster.h"

#include <QGuiApplication>
#include <QKeySequence>
#include <QSysInfo>
#include <QTextStream>

namespace posewire::gui {

namespace {

QString plainText(const char* words) {
    return QCoreApplication::translate("Action", words).remove(QLatin1Char('&'));
}

void writeReceiving(QTextStream& out, const ReceivingState& receiving) {
    for (const PortState& port : receiving.ports) {
        out << displayText(port.port) << ": " << inputState(port).text << ", " << port.status.datagrams
            << " datagrams, " << port.status.kernelDropped << " dropped here, "
            << port.status.refusedDatagrams << " refused\n";
    }
    for (const RelayState& relay : receiving.relays) {
        out << "relay to " << displayText(relay.target) << ": " << relayStage(relay).text << ", "
            << relay.sent << " sent, " << relay.refused << " refused, " << relay.skipped << " skipped, "
            << relay.behind << " behind\n";
    }
    for (const net::Finding& finding : receiving.findings) {
        out << "found: " << QString::fromStdString(finding.text) << '\n';
    }
    out << "receive buffer " << receiving.receiveBufferBytes << " bytes, dropped here "
        << receiving.kernelDropped << ", " << receiving.datagramsPerSecond << " datagrams/s, "
        << receiving.bytesPerSecond << " bytes/s\n";
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

/// All keys of the menus.
QString shortcutsMarkdown() {
    QString text = tr("| Key | Menu | What it does |\n|---|---|---|\n");
    for (const MenuEntry& entry : menuEntries()) {
        const ActionInfo& info = *entry.action;
        const QKeySequence keys(QLatin1String(info.shortcut), QKeySequence::PortableText);
        if (!keys.isEmpty()) {
            text += QStringLiteral("| %1 | %2 | %3 |\n")
                        .arg(keys.toString(QKeySequence::NativeText),
                             plainText(info.menu).replace(QLatin1Char('/'), QStringLiteral(" > ")),
                             plainText(info.text));
        }
    }
    return text;
}

/// The columns of the statistics, in their order and in the words of their tooltips.
QString figuresMarkdown() {
    QString text = tr("| Column | What it says |\n|---|---|\n");
    for (int column = kNameColumn + 1; column < kStatisticsColumns; ++column) {
        if (const auto figure = figureIn(column)) {
            const model::FigureRow& row = model::rowOf(*figure);
            text += QStringLiteral("| %1 | %2 |\n").arg(tr(row.shortTitle()), tr(row.help));
        } else {
            text +=
                tr("| Curve | Rate over the range, or over the last two minutes; marked where samples were "
                   "lost |\n");
        }
    }
    return text;
}

/// Without its title, which is that of the page.
QString protocolMarkdown() {
    return QString::fromStdString(exporting::protocolReference()).section(u'\n', 1).trimmed();
}

} // namespace

QMap<QString, QString> madeHelpParts() {
    return {{QStringLiteral("shortcuts"), shortcutsMarkdown()},
            {QStringLiteral("figures"), figuresMarkdown()},
            {QStringLiteral("protocol"), protocolMarkdown()}};
}

void showAbout(QWidget& parent) {
    auto* box =
        new MessageBox(tr("About Posewire"), tr("Posewire %1").arg(QCoreApplication::applicationVersion()),
                       QMessageBox::Close, &parent);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setIconPixmap(applicationIcon().pixmap(64));
    box->setInformativeText(tr("Network monitor for MVN motion-capture streams.\n\nThe application is free "
                               "software under the GNU "
                               "General Public License, version 3 or later; its core and renderer are under "
                               "the MIT licence.\n\nQt %1")
                                .arg(QLatin1String(qVersion())));
    box->open();
}

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
