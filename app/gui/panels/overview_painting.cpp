// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/overview_painting.h"

#include "app/gui/theme/theme.h"

#include <QPainter>

#include <algorithm>

namespace posewire::gui {

namespace {

/// With fractions.
using Nanoseconds = std::chrono::duration<double, std::nano>;

double placeIn(const QRectF& rect, const model::TimeRange& span, log::Stamp stamp) {
    const Nanoseconds length = std::max(log::Duration(1), span.to - span.from);
    return std::clamp(rect.left() + (stamp - span.from) / length * rect.width(), rect.left(), rect.right());
}

void paintRate(QPainter& painter, const RangeOverview& overview, const QRectF& rect) {
    const model::RangeParts& parts = overview.parts();
    const auto& counted = overview.counted();
    // The last part is still being filled: it would always look like a loss.
    const std::size_t count =
        parts.beginOf(parts.count) > overview.span().to && parts.count > 1 ? parts.count - 1 : parts.count;
    std::uint32_t most = 1;
    for (std::size_t i = 0; i < count; ++i) {
        most = std::max(most, counted[i].datagrams);
    }
    const auto placeOf = [&](log::Stamp stamp) { return placeIn(rect, overview.span(), stamp); };
    const double scale = (rect.height() - 4.0) / most;
    QPolygonF area{{placeOf(parts.first), rect.bottom()}};
    double right = rect.left();
    for (std::size_t i = 0; i < count; ++i) {
        const double y = rect.bottom() - counted[i].datagrams * scale;
        right = i + 1 == count ? rect.right() : placeOf(parts.beginOf(i + 1));
        area << QPointF(placeOf(parts.beginOf(i)), y) << QPointF(right, y);
    }
    area << QPointF(right, rect.bottom());
    painter.setBrush(withAlpha(theme().accent, 0.35));
    painter.drawPolygon(area);
}

void paintLosses(QPainter& painter, const RangeOverview& overview, const QRectF& rect) {
    const model::RangeParts& parts = overview.parts();
    const double high = rect.height() / 3;
    painter.setBrush(theme().warning);
    for (std::size_t i = 0; i < parts.count; ++i) {
        if (overview.counted()[i].lost != 0) {
            const double left = placeIn(rect, overview.span(), parts.beginOf(i));
            const double right = placeIn(rect, overview.span(), parts.beginOf(i + 1));
            painter.drawRect(QRectF(left, rect.bottom() - high, std::max(2.0, right - left), high));
        }
    }
}

} // namespace

void paintOverview(QPainter& painter, const RangeOverview& overview, const QRectF& rect) {
    painter.setPen(Qt::NoPen);
    paintRate(painter, overview, rect);
    paintLosses(painter, overview, rect);
}

} // namespace posewire::gui
