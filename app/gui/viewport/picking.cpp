// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/picking.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/viewport/camera_motion.h"
#include "core/model/session/roster.h"

#include <QLineF>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

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

/// Returns the box from elbow to fingertips if these are as high as the head; else an empty one.
QRectF raisedArm(const Figure& figure, std::size_t foreArm, const render::Camera& camera,
                 const QSizeF& size) {
    constexpr float kTips = 0.75F;  // of a forearm, beyond the wrist
    constexpr float kThick = 0.06F; // metres
    constexpr float kBelow = 0.45F; // the label's place above the shoulders
    if (figure.body == nullptr) {
        return {};
    }
    const auto place = [&figure](std::size_t segment) {
        return render::transformPoint(figure.palette[segment], figure.body->fit.origins[segment]);
    };
    const glm::vec3 elbow = place(foreArm);
    const glm::vec3 wrist = place(foreArm + 1);
    const glm::vec3 tips = wrist + kTips * (wrist - elbow);
    const auto from = camera.project(elbow, aspectOf(size));
    const auto to = camera.project(tips, aspectOf(size));
    const auto beside = camera.project(tips + kThick * camera.right(), aspectOf(size));
    if (tips.z < figure.labelPosition.z - kBelow || !from || !to || !beside) {
        return {};
    }
    const qreal thick = QLineF(pointerAt(*to, size), pointerAt(*beside, size)).length();
    return QRectF(pointerAt(*from, size), pointerAt(*to, size))
        .normalized()
        .adjusted(-thick, -thick, thick, thick);
}

/// Nothing where the head is behind the eye.
std::optional<ViewportLabel> labelOf(const Figure& figure, const render::Camera& camera,
                                     model::SessionView& session, const QSizeF& size) {
    constexpr float kAboveHead = 0.05F; // metres, and the head below that
    constexpr float kHeadHeight = 0.3F;
    const glm::vec3 top = figure.labelPosition - glm::vec3(0, 0, kAboveHead);
    const auto anchor = camera.project(figure.labelPosition, aspectOf(size));
    const auto crown = camera.project(top, aspectOf(size));
    const auto chin = camera.project(top - kHeadHeight * camera.up(), aspectOf(size));
    if (!anchor || !crown || !chin) {
        return std::nullopt;
    }
    ViewportLabel label;
    label.key = figure.key;
    label.anchor = pointerAt(*anchor, size);
    const QPointF above = pointerAt(*crown, size);
    const qreal height = std::abs(pointerAt(*chin, size).y() - above.y());
    label.head = QRectF(above.x() - 0.4 * height, above.y(), 0.8 * height, height);
    label.arms = {raisedArm(figure, render::RightForeArm, camera, size),
                  raisedArm(figure, render::LeftForeArm, camera, size)};
    label.depth = glm::dot(figure.labelPosition - camera.eye(), camera.forward());
    label.mark = {QColor::fromRgbF(figure.look.colour.r, figure.look.colour.g, figure.look.colour.b),
                  figure.key.character};
    label.name = nameApart(session, figure.key);
    label.state = characterHealth(session, figure.key);
    label.isSelected = session.roster().isSelected(figure.key);
    return label;
}

/// True if a ray meets a body within a distance; `without` is left out.
bool isMet(const SceneFrame& frame, const render::Ray& ray, float distance, const Figure* without) {
    constexpr float kFlesh = 0.3F; // metres around the origins of segments
    const auto mayMeet = [&](const Figure& figure) {
        const glm::vec3 least = (figure.bounds.min - kFlesh - ray.origin) / ray.direction;
        const glm::vec3 most = (figure.bounds.max + kFlesh - ray.origin) / ray.direction;
        const glm::vec3 in = glm::min(least, most);
        const glm::vec3 out = glm::max(least, most);
        const float begin = std::max({in.x, in.y, in.z});
        return begin < distance && begin <= std::min({out.x, out.y, out.z});
    };
    return std::ranges::any_of(frame.figures, [&](const Figure& figure) {
        if (&figure == without || figure.body == nullptr || figure.bounds.isEmpty() || !mayMeet(figure)) {
            return false;
        }
        const render::PickTarget target = targetOf(figure, 0);
        const auto pick = render::pickSegment(ray, std::span(&target, 1));
        return pick && pick->distance < distance;
    });
}

/// True if a place lies deeper in a body than its middle: on the side that is not seen.
bool isOnFarSide(const SceneFrame& frame, const glm::vec3& place, const QPointF& there, const QSizeF& view) {
    constexpr float kHalfBody = 0.13F; // metres
    const render::Ray ray = frame.camera.rayThrough(screenPoint(there, view), aspectOf(view));
    return isMet(frame, ray, glm::dot(place - ray.origin, ray.direction) - kHalfBody, nullptr);
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
    const render::Ray ray = frame.camera.rayThrough(screenPoint(there, view), aspectOf(view));
    const float own = glm::dot(frame.figures[which].labelPosition - ray.origin, ray.direction);
    return isMet(frame, ray, own, &frame.figures[which]);
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

std::vector<ViewportLabel> labelsOf(const SceneFrame& frame, model::SessionView& session,
                                    const QSizeF& size) {
    std::vector<ViewportLabel> labels;
    for (std::size_t i = 0; i < frame.figures.size(); ++i) {
        const Figure& figure = frame.figures[i];
        if (auto label = labelOf(figure, frame.camera, session, size)) {
            label->isBehind = figure.body != nullptr && isBehindAnother(frame, i, label->head.center(), size);
            labels.push_back(std::move(*label));
        }
    }
    return labels;
}

std::vector<ViewportText> textsOf(const SceneFrame& frame, const QSizeF& size) {
    constexpr float kFarStrength = 0.5F;
    using Order = std::tuple<bool, bool, float>; // of the floor, of a far side, depth
    std::vector<std::pair<Order, ViewportText>> all;
    for (const SceneText& text : frame.texts) {
        if (const auto place = frame.camera.project(text.position, aspectOf(size))) {
            const QPointF there = pointerAt(*place, size);
            const bool isFar = text.isOfBody && isOnFarSide(frame, text.position, there, size);
            const float depth = glm::dot(text.position - frame.camera.eye(), frame.camera.forward());
            QColor colour = text.colour;
            colour.setAlphaF(isFar ? kFarStrength : 1.0F);
            all.push_back({{text.isScale, isFar, depth}, {there, text.text, colour, text.isOfBody}});
        }
    }
    std::ranges::stable_sort(all, {}, [](const auto& one) { return one.first; });
    std::vector<ViewportText> texts;
    for (auto& [order, text] : all) {
        texts.push_back(std::move(text));
    }
    if (frame.hasNamesLeftOut) {
        texts.push_back({{}, tr("Names are shown of the selected character"), theme().dim, false, true});
    }
    return texts;
}

} // namespace posewire::gui
