// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/dialogs.h"

#include "app/gui/theme/theme.h"
#include "app/gui/window/actions.h"

#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QKeySequence>
#include <QScrollBar>
#include <QTextBrowser>
#include <QTextDocument>
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

void showText(const QString& title, const QString& markdown, QWidget* parent) {
    auto* dialog = new QDialog(parent);
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

QString shortcutsText() {
    QString text = QCoreApplication::translate("Dialogs", "| Key | Menu | What it does |\n|---|---|---|\n");
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
    return text +
           QCoreApplication::translate(
               "Dialogs",
               "\nIn the viewport: drag to orbit, Shift or the middle button to pan, the wheel to zoom "
               "towards the pointer; click to select a segment, double click to frame a character.\n");
}

QString aboutText() {
    return QCoreApplication::translate(
               "Dialogs", "# Posewire %1\n\nNetwork monitor for MVN motion-capture streams.\n\n"
                          "The application is free software under the GNU General Public License, version 3 "
                          "or later; its core and renderer are under the MIT licence.\n\nQt %2\n")
        .arg(QCoreApplication::applicationVersion(), QLatin1String(qVersion()));
}

} // namespace posewire::gui
