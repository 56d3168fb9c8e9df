// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/icon_drawing.h"

#include <QImage>

namespace posewire::gui {

void drawTinted(QPainter& painter, const QRect& place, const QByteArray& picture, const QColor& colour) {
    const QSize size = place.size() * painter.device()->devicePixelRatio();
    QImage tinted = QImage::fromData(picture)
                        .scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                        .convertToFormat(QImage::Format_ARGB32_Premultiplied);
    QPainter tint(&tinted);
    tint.setCompositionMode(QPainter::CompositionMode_SourceIn);
    tint.fillRect(tinted.rect(), colour);
    tint.end();
    painter.drawImage(place, tinted);
}

} // namespace posewire::gui
