// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFontMetricsF>
#include <QPainter>
#include <QRectF>
#include <QString>

namespace posewire::gui {

/// The least width at which `text` takes no more lines than at `most`: its lines are then about equally long,
/// and no word is left alone in the last one. Pixels.
[[nodiscard]] qreal balancedWidth(const QFontMetricsF& metrics, const QString& text, qreal most);

/// Draws `text` in the middle of `room`, in balanced lines, with the painter's font and pen.
void drawBalanced(QPainter& painter, const QRectF& room, const QString& text);

} // namespace posewire::gui
