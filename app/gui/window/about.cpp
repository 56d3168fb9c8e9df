// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/about.h"

#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "app/gui/window/main_window.h"

#include <QCoreApplication>
#include <QFile>

namespace posewire::gui {

namespace {

/// The libraries that the program calls, with their licences.
QString libraryLicences() {
    QFile table(QStringLiteral(":/libraries"));
    QStringList libraries;
    if (table.open(QIODevice::ReadOnly)) {
        for (const QString& row : QString::fromUtf8(table.readAll()).split(u'\n')) {
            const QStringList cells = row.split(u'|');
            if (cells.size() == 4) {
                const QChar unbroken(0x2011); // a hyphen that ends no line
                libraries += QStringLiteral("%1 (%2)").arg(cells[3].trimmed(),
                                                           cells[1].trimmed().replace(u'-', unbroken));
            }
        }
    }
    return libraries.join(QStringLiteral(", "));
}

} // namespace

void showAbout(MainWindow& window) {
    auto* box =
        new MessageBox(tr("About Posewire"), tr("Posewire %1").arg(QCoreApplication::applicationVersion()),
                       QMessageBox::Close, &window);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setIconPixmap(applicationIcon().pixmap(64));
    box->setInformativeText(tr("Network monitor for MVN motion-capture streams.\n\nThe application is free "
                               "software under the GNU "
                               "General Public License, version 3 or later; its core and renderer are under "
                               "the MIT licence.\n\nQt %1. Libraries: %2")
                                .arg(QLatin1String(qVersion()), libraryLicences()));
    box->open();
}

} // namespace posewire::gui
