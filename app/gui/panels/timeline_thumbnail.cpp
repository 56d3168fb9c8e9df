// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/timeline_thumbnail.h"

#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/overview_painting.h"
#include "app/gui/panels/timeline_view.h"
#include "app/gui/theme/theme.h"

#include <QMouseEvent>
#include <QPainter>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr double kLeastLens = 6; // pixels: it can be seen, however short the window is

using Nanoseconds = std::chrono::duration<double, std::nano>;

} // namespace

TimelineThumbnail::TimelineThumbnail(model::SessionView& view, TimelineView& timeline, QWidget* parent)
    : QWidget(parent), m_timeline(timeline), m_overview(view) {
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    setToolTip(tr("All there is, with losses marked; drag to move what the timeline shows"));
    connect(&timeline, &TimelineView::windowChanged, this, qOverload<>(&QWidget::update));
}

QSize TimelineThumbnail::sizeHint() const {
    return {0, fontMetrics().height() * 3 / 2};
}

void TimelineThumbnail::refresh() {
    m_overview.refresh();
    update();
}

QRectF TimelineThumbnail::strip() const {
    return QRectF(rect()).adjusted(m_timeline.namesWidth() + 1, 1, 0, 0);
}

QRectF TimelineThumbnail::lens() const {
    const model::TimeRange& span = m_overview.span();
    const Nanoseconds length = std::max(log::Duration(1), span.to - span.from);
    const QRectF all = strip();
    const double from = (m_timeline.window().from - span.from) / length * all.width();
    const double wide = (m_timeline.window().to - m_timeline.window().from) / length * all.width();
    const double shown = std::clamp(wide, kLeastLens, all.width());
    const double left = std::clamp(from - (shown - wide) / 2, 0.0, all.width() - shown);
    return {all.left() + left, all.top(), shown, all.height()};
}

void TimelineThumbnail::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().header);
    painter.fillRect(QRect(0, 0, width(), 1), theme().line);
    if (m_overview.empty()) {
        return;
    }
    const int margin = CellDelegate::margin(fontMetrics());
    painter.setPen(theme().dim);
    painter.drawText(QRect(margin, 0, m_timeline.namesWidth() - margin, height()),
                     Qt::AlignVCenter | Qt::AlignLeft, tr("All"));
    paintOverview(painter, m_overview, strip());
    const QRectF shown = lens();
    const QColor shade = withAlpha(theme().header, 0.6);
    painter.fillRect(QRectF(strip().topLeft(), QPointF(shown.left(), strip().bottom())), shade);
    painter.fillRect(QRectF(shown.topRight(), strip().bottomRight()), shade);
    painter.setPen(QPen(theme().accent, 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(shown.adjusted(0.5, 0.5, -0.5, -0.5));
}

void TimelineThumbnail::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton) {
        moveTo(event->position().x());
    }
}

void TimelineThumbnail::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons().testFlag(Qt::LeftButton)) {
        moveTo(event->position().x());
    }
}

/// The middle of what the timeline shows.
void TimelineThumbnail::moveTo(double place) {
    if (m_overview.empty()) {
        return;
    }
    const model::TimeRange& span = m_overview.span();
    const double share = std::clamp((place - strip().left()) / std::max(1.0, strip().width()), 0.0, 1.0);
    const log::Stamp middle =
        span.from + std::chrono::duration_cast<log::Duration>(share * Nanoseconds(span.to - span.from));
    const log::Duration half = (m_timeline.window().to - m_timeline.window().from) / 2;
    m_timeline.setWindow({middle - half, middle + half});
}

} // namespace posewire::gui
