// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/camera_state.h"

#include <QJsonArray>

#include <algorithm>
#include <numbers>

namespace posewire::gui {

namespace {

/// Of a target, metres: halls are smaller.
constexpr double kFarthest = 1'000;

float number(const QJsonValue& value, double usual, double least, double most) {
    return static_cast<float>(std::clamp(value.toDouble(usual), least, most));
}

} // namespace

QJsonObject stateOf(const CameraMotion& motion) {
    const render::Camera& camera = motion.camera();
    return {{"target", QJsonArray{camera.target.x, camera.target.y, camera.target.z}},
            {"yaw", camera.yaw},
            {"pitch", camera.pitch},
            {"distance", camera.distance},
            {"orthographic", camera.projection == render::Projection::Orthographic},
            {"standardView", motion.standardView() ? static_cast<int>(*motion.standardView()) : -1},
            {"following", motion.isFollowing()}};
}

void restore(CameraMotion& motion, const QJsonObject& state) {
    render::Camera camera = motion.camera();
    const QJsonArray target = state["target"].toArray();
    for (int axis = 0; axis < 3; ++axis) {
        camera.target[axis] =
            number(target.at(axis), static_cast<double>(camera.target[axis]), -kFarthest, kFarthest);
    }
    constexpr double turn = 2 * std::numbers::pi;
    camera.yaw = number(state["yaw"], static_cast<double>(camera.yaw), -turn, turn);
    camera.pitch = number(state["pitch"], static_cast<double>(camera.pitch), -turn, turn);
    camera.distance = number(state["distance"], static_cast<double>(camera.distance), 0, kFarthest);
    camera.orbit(0, 0); // within what an operator can reach
    camera.zoom(1);
    camera.projection =
        state["orthographic"].toBool() ? render::Projection::Orthographic : render::Projection::Perspective;
    const int view = state["standardView"].toInt(-1);
    const bool isStandard = view >= 0 && view <= static_cast<int>(render::StandardView::ThreeQuarter);
    motion.restore(camera, state["following"].toBool(true),
                   isStandard ? std::optional(static_cast<render::StandardView>(view)) : std::nullopt);
}

} // namespace posewire::gui
