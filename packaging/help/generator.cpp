// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/guide.h"
#include "packaging/help/help_html.h"

#include <QDir>
#include <QFile>
#include <QGuiApplication>

#include <iostream>

namespace {

using namespace posewire::gui;

bool write(const QString& path, const QString& text) {
    QFile file(path);
    const QByteArray bytes = text.toUtf8();
    const bool isWritten = file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
    file.close();
    if (!isWritten || file.error() != QFileDevice::NoError) {
        std::cerr << "cannot write " << path.toStdString() << '\n';
        return false;
    }
    return true;
}

} // namespace

/// help_generator OUTPUT: writes the pages of the user guide, and what their search looks through, as HTML.
int main(int argc, char** argv) {
    qputenv("QT_QPA_PLATFORM", "offscreen"); // pages are read as documents, which have fonts
    const QGuiApplication application(argc, argv);
    if (argc != 2) {
        std::cerr << "usage: help_generator OUTPUT\n";
        return 2;
    }
    const QString output = QFile::decodeName(argv[1]) + u'/';
    const HelpPages pages(madeHelpParts());
    bool isWritten = QDir().mkpath(output) && write(output + QStringLiteral("pages.js"), searchIndex(pages));
    for (const HelpPage& page : pages.all()) {
        isWritten = isWritten && write(output + page.id + QStringLiteral(".html"), helpHtml(pages, page));
    }
    return isWritten ? 0 : 1;
}
