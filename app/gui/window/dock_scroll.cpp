// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/dock_scroll.h"

#include <QEvent>
#include <QLayout>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kLeastLines = 3;

/// What the content needs at a width without being squeezed.
int leastHeight(const QWidget& content, int width) {
    const QLayout* layout = content.layout();
    const bool isWrapping = layout != nullptr && layout->hasHeightForWidth();
    return isWrapping ? layout->totalMinimumHeightForWidth(width) : content.minimumSizeHint().height();
}

} // namespace

DockScroll::DockScroll(QWidget* content, QWidget* parent) : QScrollArea(parent) {
    setFrameShape(QFrame::NoFrame);
    setFocusPolicy(Qt::NoFocus);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setWidget(content);
}

QSize DockScroll::sizeHint() const {
    return widget()->sizeHint().expandedTo(minimumSizeHint());
}

QSize DockScroll::minimumSizeHint() const {
    const QSize content = widget()->minimumSizeHint();
    return {content.width(), std::min(content.height(), fontMetrics().height() * kLeastLines)};
}

/// QScrollArea's own fitting would give content with wrapped texts the height it likes best.
void DockScroll::fitContent() {
    const int width = viewport()->width();
    const int height = std::max(maximumViewportSize().height(), leastHeight(*widget(), width));
    widget()->resize(width, height);
}

bool DockScroll::eventFilter(QObject* watched, QEvent* event) {
    const bool isDone = QScrollArea::eventFilter(watched, event);
    if (watched == widget() && event->type() == QEvent::LayoutRequest) {
        fitContent();
        updateGeometry();
    }
    return isDone;
}

void DockScroll::resizeEvent(QResizeEvent* event) {
    QScrollArea::resizeEvent(event);
    fitContent();
}

} // namespace posewire::gui
