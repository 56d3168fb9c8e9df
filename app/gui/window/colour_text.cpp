// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/colour_text.h"

#include <QKeyEvent>
#include <QPainter>

namespace posewire::gui {

ColourText::ColourText(Look look, QWidget* parent) : QAbstractButton(parent), m_look(look) {
    setFont(tabularFont());
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    setFocusPolicy(Qt::TabFocus);
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);
}

void ColourText::setContent(Health level, const QString& text) {
    const QString line = level == Health::Unknown ? text : healthSymbol(level) + QLatin1Char(' ') + text;
    if (line != this->text()) {
        setText(line);
        setAccessibleName(text);
        updateGeometry();
    }
    if (level != m_level) {
        m_level = level;
        update();
    }
}

QSize ColourText::sizeHint() const {
    const QFontMetrics metrics = fontMetrics();
    const int margin = m_look == Look::Pill ? metrics.height() : metrics.height() / 2;
    return {metrics.horizontalAdvance(text()) + margin + 2, metrics.height() + 6};
}

void ColourText::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool isActive = underMouse() || hasFocus();
    const QRectF frame = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
    if (m_look == Look::Pill || isActive) {
        const QColor plain = m_level == Health::Error ? theme().error : theme().line;
        painter.setPen(hasFocus() ? QPen(theme().accent, 2) : QPen(plain, 1));
        painter.setBrush(isActive ? theme().raised : Qt::transparent);
        const qreal radius = m_look == Look::Pill ? frame.height() / 2 : 4;
        painter.drawRoundedRect(frame, radius, radius);
    }
    painter.setPen(healthColour(m_level));
    if (m_look == Look::Pill) {
        painter.drawText(rect(), Qt::AlignCenter, text());
        return;
    }
    const int margin = marginsOf(fontMetrics()) / 2;
    const QRect room = rect().adjusted(margin, 0, -margin, 0);
    painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(text(), Qt::ElideRight, room.width() + 1));
}

/// Enter as well as the space bar.
void ColourText::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
        click();
        return;
    }
    QAbstractButton::keyPressEvent(event);
}

} // namespace posewire::gui
