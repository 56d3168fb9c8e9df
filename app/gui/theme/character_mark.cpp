// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/character_mark.h"

#include <QPainter>
#include <QPainterPath>
#include <QPolygonF>

#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace posewire::gui {

namespace {

using MakeShape = QPainterPath (*)();

/// Points in a square from -1 to 1, y down.
QPainterPath polygon(std::initializer_list<QPointF> points) {
    QPainterPath path;
    path.addPolygon(QPolygonF(QList<QPointF>(points)));
    path.closeSubpath();
    return path;
}

QPainterPath disc(qreal radius) {
    QPainterPath path;
    path.addEllipse(QPointF(), radius, radius);
    return path;
}

QPainterPath square(qreal half) {
    QPainterPath path;
    path.addRect(-half, -half, 2 * half, 2 * half);
    return path;
}

QPainterPath star() {
    QPolygonF points;
    for (int i = 0; i < 10; ++i) {
        const double angle = std::numbers::pi * (i / 5.0 - 0.5);
        const double radius = i % 2 == 0 ? 1.15 : 0.5;
        points += QPointF(radius * std::cos(angle), radius * std::sin(angle));
    }
    QPainterPath path;
    path.addPolygon(points);
    path.closeSubpath();
    return path;
}

constexpr std::array<MakeShape, CharacterMark::kShapes> kShapeTable{
    [] { return disc(1); },
    [] {
        return polygon({{0, -1.2}, {1.2, 0}, {0, 1.2}, {-1.2, 0}});
    },
    [] { return disc(1.05).subtracted(disc(0.55)); },
    [] {
        QPainterPath path;
        path.addRect(-1.1, -0.38, 2.2, 0.76);
        path.addRect(-0.38, -1.1, 0.76, 2.2);
        return path.simplified();
    },
    [] {
        return polygon({{-1.15, -0.85}, {1.15, -0.85}, {0, 1.1}});
    },
    star,
    [] {
        return polygon({{-0.95, -1.05}, {0.95, -1.05}, {-0.95, 1.05}, {0.95, 1.05}});
    },
    [] { return square(0.95).subtracted(square(0.45)); },
};

} // namespace

void paintMark(QPainter& painter, const QRectF& place, const CharacterMark& mark) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(place.center());
    painter.scale(place.width() / 2, place.height() / 2);
    painter.fillPath(kShapeTable[static_cast<std::size_t>(std::abs(mark.shape) % CharacterMark::kShapes)](),
                     mark.colour);
    painter.restore();
}

} // namespace posewire::gui
