// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/elided_label.h"

#include "app/gui/theme/theme.h"

#include <QPainter>

#include <algorithm>

namespace posewire::gui {

ElidedLabel::ElidedLabel(Qt::Alignment alignment, QWidget* parent) : QWidget(parent), m_alignment(alignment) {
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
}

void ElidedLabel::setText(const QString& text, const QString& dim) {
    if (text == m_text && dim == m_dim) {
        return;
    }
    m_text = text;
    m_dim = dim;
    setAccessibleName(this->text());
    updateGeometry();
    update();
}

QSize ElidedLabel::sizeHint() const {
    return {fontMetrics().horizontalAdvance(text()), fontMetrics().height()};
}

QSize ElidedLabel::minimumSizeHint() const {
    return {0, fontMetrics().height()};
}

void ElidedLabel::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    const QFontMetrics metrics = fontMetrics();
    const QString shown = metrics.elidedText(text(), Qt::ElideRight, width());
    const qsizetype bright = std::min(m_text.size(), shown.size());
    QRect room = rect();
    if (m_alignment.testFlag(Qt::AlignRight)) {
        room.setLeft(room.right() + 1 - metrics.horizontalAdvance(shown));
    }
    const auto draw = [&](const QString& part, const QColor& colour) {
        painter.setPen(colour);
        painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine, part);
        room.setLeft(room.left() + metrics.horizontalAdvance(part));
    };
    draw(shown.left(bright), theme().text);
    draw(shown.mid(bright), theme().dim);
}

} // namespace posewire::gui
