// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/texts.h"

#include "app/gui/models/receiving_models.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/words.h"
#include "app/gui/window/menus.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QKeySequence>
#include <QScrollBar>
#include <QSysInfo>
#include <QTextBrowser>
#include <QTextDocument>
#include <QTextStream>
#include <QTextTable>
#include <QVBoxLayout>
#include <QtMath>

#include <algorithm>
#include <memory>

namespace posewire::gui {

namespace {

/// Room for the whole text in lines that can be read, and for a part of it where that is long.
QSize sizeOf(const QTextBrowser& browser) {
    const QFontMetrics metrics = browser.fontMetrics();
    const qreal most = metrics.averageCharWidth() * 100;
    const std::unique_ptr<QTextDocument> copy(browser.document()->clone());
    copy->setTextWidth(most);
    const qreal width = std::min(most, copy->idealWidth());
    copy->setTextWidth(width);
    const qreal height = std::min<qreal>(copy->size().height(), metrics.lineSpacing() * 40);
    const int scrollBar = browser.verticalScrollBar()->sizeHint().width();
    return {qCeil(width) + 2 * scrollBar, qCeil(height) + 3 * metrics.lineSpacing() / 2};
}

QString plainText(const char* words) {
    return QCoreApplication::translate("Action", words).remove(QLatin1Char('&'));
}

void writeReceiving(QTextStream& out, const ReceivingState& receiving) {
    for (const PortState& port : receiving.ports) {
        out << displayText(port.port) << ": " << inputState(port).text << ", " << port.status.datagrams
            << " datagrams, " << port.status.kernelDropped << " dropped here\n";
    }
    for (const RelayState& relay : receiving.relays) {
        out << "relay to " << displayText(relay.target) << ": " << relayStage(relay).text << ", "
            << relay.sent << " sent, " << relay.refused << " refused, " << relay.skipped << " skipped\n";
    }
    for (const net::Finding& finding : receiving.findings) {
        out << "found: " << QString::fromStdString(finding.text) << '\n';
    }
    out << "receive buffer " << receiving.receiveBufferBytes << " bytes, dropped here "
        << receiving.kernelDropped << ", " << receiving.datagramsPerSecond << " datagrams/s, "
        << receiving.bytesPerSecond << " bytes/s\n";
}

void writeSenders(QTextStream& out, model::SessionView& session) {
    for (const model::Sender& sender : session.senders()) {
        out << "sender " << QString::fromStdString(sender.info.address) << ": " << sender.datagrams
            << " datagrams, " << sender.malformed << " malformed, " << sender.foreign << " foreign, "
            << sender.skippedBytes << " bytes skipped\n";
    }
    for (const model::Stream& stream : session.streams()) {
        const model::CharacterKey key{stream.key.sender, stream.key.character};
        out << "stream " << QString::fromStdString(session.displayName(key)) << " type " << stream.key.type
            << ": " << stream.accounting.datagrams() << " datagrams, " << stream.statistics.rateHz()
            << " Hz, " << stream.accounting.counts().lost << " lost, " << stream.accounting.malformed()
            << " malformed\n";
    }
}

/// A window with text to read, in Markdown; deletes itself when closed.
void showText(const QString& title, const QString& markdown, QWidget& parent) {
    auto* dialog = new QDialog(&parent);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(title);
    auto* browser = new QTextBrowser(dialog);
    browser->setFrameShape(QFrame::NoFrame);
    browser->setOpenExternalLinks(true);
    browser->setMarkdown(markdown);
    styleTables(*browser->document());
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, dialog);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    auto* column = new QVBoxLayout(dialog);
    column->addWidget(browser);
    column->addWidget(buttons);
    dialog->resize(dialog->sizeHint() - browser->sizeHint() + sizeOf(*browser));
    dialog->show();
}

} // namespace

void styleTables(QTextDocument& document) {
    constexpr qreal kPadding = 4;
    for (QTextFrame* frame : document.rootFrame()->childFrames()) {
        auto* table = qobject_cast<QTextTable*>(frame);
        if (table == nullptr) {
            continue;
        }
        QTextTableFormat format = table->format();
        format.setBorderStyle(QTextFrameFormat::BorderStyle_Solid);
        format.setBorderBrush(theme().line);
        format.setBorder(1);
        format.setBorderCollapse(true);
        format.setCellPadding(kPadding);
        format.setCellSpacing(0);
        table->setFormat(format);
        for (int column = 0; column < table->columns(); ++column) {
            QTextTableCell cell = table->cellAt(0, column);
            QTextCharFormat header = cell.format();
            header.setBackground(theme().raised);
            header.setForeground(theme().dim);
            cell.setFormat(header);
        }
    }
    // Else headings behind tables keep the height that they had while these were changed: none.
    document.markContentsDirty(0, document.characterCount());
}

void showShortcuts(QWidget& parent) {
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
    text += tr("\nIn the viewport: drag to orbit, Shift or the middle button to pan, the wheel to zoom "
               "towards the pointer; click to select a segment, double click to frame a character.\n");
    showText(tr("Keyboard shortcuts"), text, parent);
}

void showAbout(QWidget& parent) {
    const QString text =
        tr("# Posewire %1\n\nNetwork monitor for MVN motion-capture streams.\n\n"
           "The application is free software under the GNU General Public License, version 3 "
           "or later; its core and renderer are under the MIT licence.\n\nQt %2\n")
            .arg(QCoreApplication::applicationVersion(), QLatin1String(qVersion()));
    showText(tr("About Posewire"), text, parent);
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
    const log::LogFigures figures = session.figures();
    out << "history: packets " << figures.begin << " to " << figures.end << ", " << figures.memoryInUse
        << " of " << figures.memoryCap << " bytes\n";
    writeSenders(out, session);
    return text;
}

} // namespace posewire::gui
