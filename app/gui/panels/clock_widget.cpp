// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/clock_widget.h"

#include "app/gui/theme/theme.h"

#include <QKeyEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

/// Pixel size at which `text` fits into `size`.
int fittingPixelSize(QFont font, const QString& text, const QSizeF& size) {
    constexpr int kProbe = 100;
    font.setPixelSize(kProbe);
    const QFontMetricsF metrics(font);
    const double byWidth = kProbe * size.width() / std::max(1.0, metrics.horizontalAdvance(text));
    const double byHeight = kProbe * size.height() / metrics.height();
    return std::max(8, static_cast<int>(std::floor(std::min(byWidth, byHeight))));
}

} // namespace

ClockWidget::ClockWidget(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Time code"));
    setFocusPolicy(Qt::StrongFocus);
    setToolTip(tr("Double-click or press F for full screen"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void ClockWidget::setClock(const QString& text, const QString& caption, Run run) {
    if (text == m_text && caption == m_caption && run == m_run) {
        return;
    }
    m_text = text;
    m_caption = caption;
    m_run = run;
    setAccessibleDescription(m_text + QLatin1Char(' ') + m_caption);
    update();
}

QSize ClockWidget::sizeHint() const {
    const int unit = fontMetrics().height();
    return {unit * 16, unit * 5};
}

QSize ClockWidget::minimumSizeHint() const {
    const int unit = fontMetrics().height();
    return {unit * 8, unit * 3};
}

void ClockWidget::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().panel);
    const int space = fontMetrics().height() / 2;
    const QFont small = font();
    const int captionHeight = m_caption.isEmpty() ? 0 : QFontMetrics(small).height();
    QRect figures = rect().adjusted(space, space / 2, -space, -space / 2 - captionHeight);

    QFont large = monospaceFont();
    large.setPixelSize(fittingPixelSize(large, m_text, figures.size()));
    painter.setFont(large);
    painter.setPen(m_run == Run::Running ? theme().text : theme().dim);
    painter.drawText(figures, Qt::AlignCenter, m_text);
    painter.setFont(small);
    painter.setPen(m_run == Run::Stale ? theme().error : theme().dim);
    const QRect below(space, figures.bottom() + 1, width() - 2 * space, captionHeight);
    painter.drawText(below, Qt::AlignCenter,
                     QFontMetrics(small).elidedText(m_caption, Qt::ElideRight, below.width()));
    if (hasFocus() && !isWindow()) {
        painter.setPen(theme().accent);
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(rect().adjusted(0, 0, -1, -1));
    }
}

void ClockWidget::mouseDoubleClickEvent(QMouseEvent*) {
    emit fullScreenToggled();
}

void ClockWidget::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_F && event->modifiers() == Qt::NoModifier) {
        emit fullScreenToggled();
    } else if (event->key() == Qt::Key_Escape && isWindow()) {
        emit left();
    } else {
        QWidget::keyPressEvent(event);
    }
}

} // namespace posewire::gui
