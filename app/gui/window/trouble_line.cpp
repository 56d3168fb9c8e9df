// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/trouble_line.h"

#include <QKeyEvent>
#include <QPainter>

namespace posewire::gui {

namespace {

constexpr int kTallest = 10'000;

} // namespace

TroubleLine::TroubleLine(Health level, const QString& text, const QString& note, QWidget* parent)
    : QAbstractButton(parent), m_level(level), m_note(note) {
    setText(text);
    setAccessibleName(text);
    setAccessibleDescription(note);
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Minimum);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
}

int TroubleLine::markWidth() const {
    return fontMetrics().horizontalAdvance(healthSymbol(m_level) + QStringLiteral("  "));
}

int TroubleLine::heightForWidth(int width) const {
    const QRect room(0, 0, width - markWidth() - 2 * margin(), kTallest);
    const int text = fontMetrics().boundingRect(room, Qt::TextWordWrap, this->text()).height();
    return text + fontMetrics().lineSpacing() + 2 * margin();
}

QSize TroubleLine::sizeHint() const {
    const int width = fontMetrics().averageCharWidth() * 56;
    return {width, heightForWidth(width)};
}

void TroubleLine::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (hasFocus() || underMouse()) {
        painter.setPen(hasFocus() ? theme().accent : theme().line);
        painter.setBrush(theme().raised);
        painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
    }
    QRect room = rect().adjusted(margin(), margin(), -margin(), -margin());
    painter.setPen(healthColour(m_level));
    painter.drawText(room, Qt::AlignLeft | Qt::AlignTop, healthSymbol(m_level));
    room.setLeft(room.left() + markWidth());
    painter.setPen(theme().text);
    painter.drawText(room, Qt::TextWordWrap | Qt::AlignLeft | Qt::AlignTop, text());
    painter.setPen(theme().dim);
    painter.drawText(room, Qt::AlignLeft | Qt::AlignBottom, m_note);
}

void TroubleLine::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
        click();
        return;
    }
    QAbstractButton::keyPressEvent(event);
}

} // namespace posewire::gui
