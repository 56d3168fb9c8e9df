// SPDX-License-Identifier: GPL-3.0-or-later
#include <QDir>
#include <QImage>
#include <QPainter>
#include <QSvgRenderer>

#include <cstdio>

/// icon_generator SVG FOLDER SIZE…: writes FOLDER/SIZE/NAME.png for each size, NAME being that of the SVG.
int main(int argc, char** argv) {
    if (argc < 4) {
        std::fputs("usage: icon_generator SVG FOLDER SIZE...\n", stderr);
        return 2;
    }
    const QString source = QString::fromLocal8Bit(argv[1]);
    QSvgRenderer drawing(source);
    if (!drawing.isValid()) {
        std::fprintf(stderr, "%s: no SVG\n", argv[1]);
        return 1;
    }
    for (int i = 3; i < argc; ++i) {
        const int size = QByteArray(argv[i]).toInt();
        QImage picture(size, size, QImage::Format_ARGB32);
        picture.fill(Qt::transparent);
        QPainter painter(&picture);
        drawing.render(&painter);
        painter.end();
        const QDir folder(QString::fromLocal8Bit(argv[2]) + u'/' + QString::number(size));
        const QString path = folder.filePath(QFileInfo(source).baseName() + QStringLiteral(".png"));
        if (!folder.mkpath(QStringLiteral(".")) || !picture.save(path)) {
            std::fprintf(stderr, "cannot write %s\n", qUtf8Printable(path));
            return 1;
        }
    }
    return 0;
}
