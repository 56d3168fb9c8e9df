// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/picking.h"

#include "app/gui/viewport/camera_motion.h"

#include <QLineF>

#include <algorithm>
#include <limits>
#include <vector>

namespace posewire::gui {
namespace {

std::optional<PickedSegment> pickOrigin(const SceneFrame& frame, const QPointF& pointer, const QSizeF& view) {
    constexpr qreal kNear = 12; // logical pixels
    std::optional<PickedSegment> picked;
    qreal nearest = kNear;
    for (const Figure& figure : frame.figures) {
        for (const FreeSegment& one : figure.free) {
            const auto screen = frame.camera.project(one.origin, aspectOf(view));
            const qreal away = screen ? QLineF(pointer, pointerAt(*screen, view)).length()
                                      : std::numeric_limits<qreal>::max();
            if (away < nearest) {
                nearest = away;
                picked = {figure.key, one.segment};
            }
        }
    }
    return picked;
}

} // namespace

std::optional<PickedSegment> pickIn(const SceneFrame& frame, const QPointF& pointer, const QSizeF& view) {
    if (const auto origin = pickOrigin(frame, pointer, view)) {
        return origin;
    }
    std::vector<render::PickTarget> targets;
    for (std::size_t i = 0; i < frame.figures.size(); ++i) {
        const Figure& figure = frame.figures[i];
        if (figure.body != nullptr) {
            targets.push_back(targetOf(figure, static_cast<std::uint32_t>(i)));
        }
    }
    const auto pick =
        render::pickSegment(frame.camera.rayThrough(screenPoint(pointer, view), aspectOf(view)), targets);
    return pick ? std::optional(PickedSegment{frame.figures[pick->id].key, pick->segment}) : std::nullopt;
}

render::PickTarget targetOf(const Figure& figure, std::uint32_t id) {
    return {id, &figure.capsules(), figure.drawnPalette()};
}

bool isBehindAnother(const SceneFrame& frame, std::size_t which, const QPointF& there, const QSizeF& view) {
    constexpr float kFlesh = 0.3F; // metres around the origins of segments
    const render::Ray ray = frame.camera.rayThrough(screenPoint(there, view), aspectOf(view));
    const float own = glm::dot(frame.figures[which].labelPosition - ray.origin, ray.direction);
    const auto mayMeet = [&ray](const Figure& figure) {
        const glm::vec3 offset = figure.bounds.centre() - ray.origin;
        const float along = glm::dot(offset, ray.direction);
        return glm::distance(offset, along * ray.direction) <= figure.bounds.radius() + kFlesh;
    };
    std::vector<render::PickTarget> others;
    for (std::size_t i = 0; i < frame.figures.size(); ++i) {
        const Figure& figure = frame.figures[i];
        if (i != which && figure.body != nullptr && !figure.bounds.isEmpty() && mayMeet(figure)) {
            others.push_back(targetOf(figure, static_cast<std::uint32_t>(i)));
        }
    }
    const auto pick = render::pickSegment(ray, others);
    return pick && pick->distance < own;
}

QRectF roomOf(const SceneFrame& frame, const model::CharacterKey& key, const QSizeF& view) {
    const auto figure = std::ranges::find(frame.figures, key, &Figure::key);
    if (figure == frame.figures.end() || figure->bounds.isEmpty()) {
        return {};
    }
    const ScreenBox box = screenBox(frame.camera, std::span(&figure->bounds, 1), aspectOf(view));
    const QRectF room(pointerAt({box.least.x, box.most.y}, view), pointerAt({box.most.x, box.least.y}, view));
    return box.isAllInFront ? room & QRectF(QPointF(), view) : QRectF();
}

} // namespace posewire::gui
