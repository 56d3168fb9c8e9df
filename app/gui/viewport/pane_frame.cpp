// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/pane_frame.h"

#include "app/gui/theme/theme.h"

#include <QPainter>

namespace posewire::gui {

PaneFrame::PaneFrame(QWidget* parent) : QWidget(parent) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
}

void PaneFrame::setPanes(const std::vector<NamedPane>& panes, int active) {
    if (panes != m_panes || active != m_active) {
        m_panes = panes;
        m_active = active;
        update();
    }
}

void PaneFrame::paintEvent(QPaintEvent* /*event*/) {
    if (m_panes.empty()) {
        return;
    }
    QPainter painter(this);
    QRegion between(rect());
    for (const NamedPane& pane : m_panes) {
        between -= pane.place;
    }
    for (const QRect& part : between) {
        painter.fillRect(part, theme().line);
    }
    constexpr int kMargin = 8;
    for (const NamedPane& pane : m_panes) {
        const QRect inner = pane.place.adjusted(kMargin, kMargin, -kMargin, -kMargin);
        const QRect words = fontMetrics().boundingRect(inner, Qt::AlignRight | Qt::AlignBottom, pane.name);
        painter.setPen(Qt::NoPen);
        painter.setBrush(withAlpha(theme().panel, 0.7));
        painter.setRenderHint(QPainter::Antialiasing);
        painter.drawRoundedRect(words.adjusted(-6, -2, 6, 2), 4, 4);
        painter.setRenderHint(QPainter::Antialiasing, false);
        painter.setPen(theme().dim);
        painter.setBrush(Qt::NoBrush);
        painter.drawText(words, Qt::AlignCenter, pane.name);
    }
    constexpr qreal kWidth = 2;
    painter.setPen(QPen(parentWidget()->hasFocus() ? theme().accent : withAlpha(theme().accent, 0.55), kWidth,
                        Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
    const QRectF active(m_panes.at(static_cast<std::size_t>(m_active)).place);
    painter.drawRect(active.adjusted(kWidth / 2, kWidth / 2, -kWidth / 2, -kWidth / 2));
}

} // namespace posewire::gui
