// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/balanced_text.h"

#include <algorithm>

namespace posewire::gui {

namespace {

QSizeF sizeAt(const QFontMetricsF& metrics, const QString& text, qreal width) {
    constexpr qreal kAnyHeight = 1e6;
    return metrics.boundingRect({0, 0, width, kAnyHeight}, Qt::TextWordWrap, text).size();
}

} // namespace

qreal balancedWidth(const QFontMetricsF& metrics, const QString& text, qreal most) {
    const qreal height = sizeAt(metrics, text, most).height();
    qreal tooNarrow = 0;
    qreal enough = most;
    while (enough - tooNarrow > 1) {
        const qreal width = (tooNarrow + enough) / 2;
        (sizeAt(metrics, text, width).height() <= height ? enough : tooNarrow) = width;
    }
    // A word that is wider than its line is not broken: it makes the line no higher.
    return std::min(most, std::max(enough, sizeAt(metrics, text, enough).width()));
}

void drawBalanced(QPainter& painter, const QRectF& room, const QString& text) {
    const qreal unused = room.width() - balancedWidth(painter.fontMetrics(), text, room.width());
    painter.drawText(room.adjusted(unused / 2, 0, -unused / 2, 0), Qt::AlignCenter | Qt::TextWordWrap, text);
}

} // namespace posewire::gui
