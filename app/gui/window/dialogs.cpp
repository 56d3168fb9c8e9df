// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/dialogs.h"

#include "app/gui/theme/theme.h"
#include "app/gui/window/actions.h"

#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QKeySequence>
#include <QTextBrowser>
#include <QTextDocument>
#include <QTextTable>
#include <QVBoxLayout>

namespace posewire::gui {

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
    const QFontMetrics metrics = dialog->fontMetrics();
    dialog->resize(metrics.averageCharWidth() * 130, metrics.lineSpacing() * 44);
    dialog->show();
}

QString shortcutsText() {
    QString text = QCoreApplication::translate("Dialogs", "| Key | What it does |\n|---|---|\n");
    for (const ActionInfo& info : actionTable()) {
        const QKeySequence keys(QLatin1String(info.shortcut), QKeySequence::PortableText);
        if (!keys.isEmpty()) {
            QString name = QCoreApplication::translate("Action", info.text);
            name.remove(QLatin1Char('&'));
            text += QStringLiteral("| %1 | %2 |\n").arg(keys.toString(QKeySequence::NativeText), name);
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
