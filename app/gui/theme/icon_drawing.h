// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QColor>
#include <QPainter>

namespace posewire::gui {

/// Draws an icon of one colour, whose file is `picture`: an SVG with the colour "currentColor", or a PNG in
/// whose place only opacity counts, if this program was built without Qt's SVG.
void drawTinted(QPainter& painter, const QRect& place, const QByteArray& picture, const QColor& colour);

} // namespace posewire::gui
