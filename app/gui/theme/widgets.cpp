// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/widgets.h"

#include "app/gui/theme/theme.h"

#include <QPainter>

#include <algorithm>

namespace posewire::gui {

QVBoxLayout* tightColumn(QWidget* parent) {
    auto* column = new QVBoxLayout(parent);
    column->setContentsMargins({});
    column->setSpacing(0);
    return column;
}

void setTextColour(QLabel& label, const QColor& colour) {
    QPalette palette = label.palette();
    palette.setColor(QPalette::WindowText, colour);
    label.setPalette(palette);
}

QLabel* dimLabel(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

QLabel* dimText(const QString& text, QWidget* parent) {
    auto* label = dimLabel(text, parent);
    label->setWordWrap(true);
    return label;
}

void Line::paintEvent(QPaintEvent* /*event*/) {
    QPainter(this).fillRect(rect(), theme().line);
}

void ComboBox::paintEvent(QPaintEvent* event) {
    QComboBox::paintEvent(event);
    QPainter painter(this);
    painter.setPen(isEnabled() ? theme().text : theme().dim);
    const int space = fontMetrics().averageCharWidth();
    painter.drawText(rect().adjusted(0, 0, -space, 0), Qt::AlignRight | Qt::AlignVCenter,
                     QStringLiteral("▾"));
}

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

PassingMessage::PassingMessage(int milliseconds, QWidget* parent) : QLabel(parent) {
    hide();
    m_timer.setSingleShot(true);
    m_timer.setInterval(milliseconds);
    connect(&m_timer, &QTimer::timeout, this, &QWidget::hide);
}

void PassingMessage::say(const QString& text) {
    setText(text);
    setToolTip(text);
    show();
    m_timer.start();
}

} // namespace posewire::gui
