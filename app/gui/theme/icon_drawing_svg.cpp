// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/icon_drawing.h"

#include <QSvgRenderer>

namespace posewire::gui {

void drawTinted(QPainter& painter, const QRect& place, const QByteArray& picture, const QColor& colour) {
    QByteArray tinted = picture;
    tinted.replace("currentColor", colour.name().toLatin1());
    QSvgRenderer renderer(tinted);
    renderer.render(&painter, QRectF(place));
}

} // namespace posewire::gui
