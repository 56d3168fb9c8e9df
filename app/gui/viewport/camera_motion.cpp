// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/camera_motion.h"

#include <QJsonArray>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace posewire::gui {

namespace {

constexpr double kRadiansPerPixel = 0.007;
constexpr double kZoomPerStep = 0.88;
/// Time in which the camera makes good two thirds of what it lags behind.
constexpr double kFollowSeconds = 0.7;
/// Share of the picture's half width and height that is filled.
constexpr float kFilled = 0.86F;
/// The camera holds while all stay within this share, and fill no less than the other.
constexpr float kHeldMost = 0.96F;
constexpr float kHeldLeast = 0.60F;
/// Once it moves, it comes closer only where the characters would be this much larger.
constexpr float kTooFar = 1.12F;
/// It comes to rest this close to where it wants to be, as a share of its distance.
constexpr float kNearEnough = 0.01F;
/// From where it is so many times farther away than it wants to be, it jumps: gliding would take seconds.
constexpr float kLost = 8;
constexpr int kFitRounds = 8;

/// Of a target, metres: halls are smaller.
constexpr double kFarthest = 1'000;

float number(const QJsonValue& value, double usual, double least, double most) {
    return static_cast<float>(std::clamp(value.toDouble(usual), least, most));
}

} // namespace

ScreenBox screenBox(const render::Camera& camera, std::span<const render::Bounds> boxes, float aspect) {
    ScreenBox box;
    for (const render::Bounds& bounds : boxes) {
        for (int corner = 0; corner < 8; ++corner) {
            const auto place = camera.project(bounds.corner(corner), aspect);
            box.isAllInFront = box.isAllInFront && place.has_value();
            if (place) {
                box.least = glm::min(box.least, *place);
                box.most = glm::max(box.most, *place);
            }
        }
    }
    return box;
}

float aspectOf(const QSizeF& view) {
    return static_cast<float>(view.width() / view.height());
}

render::Camera fitted(render::Camera camera, std::span<const render::Bounds> boxes, float aspect) {
    render::Bounds all;
    for (const render::Bounds& box : boxes) {
        if (!box.isEmpty()) {
            all.add(box);
        }
    }
    if (all.isEmpty()) {
        return camera;
    }
    // From a place that surely sees everything, a few steps of moving to the middle and closer.
    camera.frame(all, aspect);
    for (int round = 0; round < kFitRounds; ++round) {
        const ScreenBox box = screenBox(camera, boxes, aspect);
        if (!box.isAllInFront) {
            break;
        }
        const float halfHeight = camera.distance * std::tan(camera.verticalFov / 2);
        const glm::vec2 middle = 0.5F * (box.least + box.most);
        camera.target += halfHeight * (middle.x * aspect * camera.right() + middle.y * camera.up());
        const glm::vec2 half = 0.5F * (box.most - box.least);
        camera.zoom(std::max(half.x, half.y) / kFilled);
    }
    return camera;
}

bool CameraMotion::isHeld(std::span<const render::Bounds> boxes, float aspect) const {
    const ScreenBox box = screenBox(m_camera, boxes, aspect);
    const glm::vec2 farthest = glm::max(glm::abs(box.least), glm::abs(box.most));
    const glm::vec2 half = 0.5F * (box.most - box.least);
    return box.isAllInFront && std::max(farthest.x, farthest.y) <= kHeldMost &&
           std::max(half.x, half.y) >= kHeldLeast;
}

glm::vec2 screenPoint(const QPointF& pointer, const QSizeF& view) {
    return {static_cast<float>(2 * pointer.x() / view.width() - 1),
            static_cast<float>(1 - 2 * pointer.y() / view.height())};
}

QPointF pointerAt(const glm::vec2& screen, const QSizeF& view) {
    return {(static_cast<double>(screen.x) + 1) / 2 * view.width(),
            (1 - static_cast<double>(screen.y)) / 2 * view.height()};
}

void CameraMotion::orbit(const QPointF& movement) {
    m_camera.orbit(static_cast<float>(-movement.x() * kRadiansPerPixel),
                   static_cast<float>(movement.y() * kRadiansPerPixel));
    m_standardView.reset();
}

void CameraMotion::pan(const QPointF& movement, const QSizeF& view) {
    m_camera.pan({static_cast<float>(movement.x() / view.height()),
                  static_cast<float>(-movement.y() / view.height())});
    m_isFollowing = false;
}

void CameraMotion::zoom(double steps, const QPointF& pointer, const QSizeF& view) {
    const float before = m_camera.distance;
    m_camera.zoom(static_cast<float>(std::pow(kZoomPerStep, steps)));
    // The point at the target's depth under the pointer stays under it.
    const float halfHeight = (before - m_camera.distance) * std::tan(m_camera.verticalFov / 2);
    const glm::vec2 place = screenPoint(pointer, view);
    m_camera.target += halfHeight * (place.x * aspectOf(view) * m_camera.right() + place.y * m_camera.up());
    m_isFollowing = false;
}

void CameraMotion::frame(std::span<const render::Bounds> boxes, float aspect) {
    m_camera = fitted(m_camera, boxes, aspect);
    m_isFollowing = true;
    m_framed = boxes.empty() ? m_framed : aspect;
}

void CameraMotion::show(const render::Bounds& box, float aspect) {
    frame(std::span(&box, 1), aspect);
    m_isFollowing = false;
}

void CameraMotion::follow(std::span<const render::Bounds> boxes, float aspect, double seconds) {
    if (!m_isFollowing || boxes.empty()) {
        return;
    }
    if (m_framed != aspect) {
        frame(boxes, aspect);
        return;
    }
    m_isGliding = m_isGliding || !isHeld(boxes, aspect);
    if (!m_isGliding) {
        return;
    }
    const render::Camera wanted = fitted(m_camera, boxes, aspect);
    if (std::max(m_camera.distance, glm::distance(wanted.target, m_camera.target)) >
        kLost * wanted.distance) {
        m_camera = wanted;
    }
    const double glide = std::isinf(seconds) ? seconds : std::clamp(seconds, 0.0, 1.0);
    const auto share = static_cast<float>(1 - std::exp(-glide / kFollowSeconds));
    m_camera.target += share * (wanted.target - m_camera.target);
    if (wanted.distance > m_camera.distance || wanted.distance * kTooFar < m_camera.distance) {
        m_camera.distance += share * (wanted.distance - m_camera.distance);
    }
    const float near = kNearEnough * m_camera.distance;
    m_isGliding = glm::distance(wanted.target, m_camera.target) > near ||
                  wanted.distance - m_camera.distance > near ||
                  m_camera.distance > wanted.distance * kTooFar + near;
}

QJsonObject stateOf(const CameraMotion& motion) {
    const render::Camera& camera = motion.camera();
    QJsonObject state{{"yaw", camera.yaw},
                      {"pitch", camera.pitch},
                      {"orthographic", camera.projection == render::Projection::Orthographic},
                      {"standardView", motion.standardView() ? static_cast<int>(*motion.standardView()) : -1},
                      {"following", motion.isFollowing()}};
    if (!motion.isFollowing()) { // else they follow from the characters, and change with them
        state["target"] = QJsonArray{camera.target.x, camera.target.y, camera.target.z};
        state["distance"] = camera.distance;
    }
    return state;
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
