// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/camera_motion.h"

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

constexpr double kRadiansPerPixel = 0.007;
constexpr double kZoomPerStep = 0.88;
/// Time in which the camera makes good two thirds of what it lags behind.
constexpr double kFollowSeconds = 0.7;
/// It comes closer only when the characters have gathered in less than this share of the picture.
constexpr float kTooFar = 1.35F;

} // namespace

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
    const float aspect = static_cast<float>(view.width() / view.height());
    m_camera.target += halfHeight * (place.x * aspect * m_camera.right() + place.y * m_camera.up());
    m_isFollowing = false;
}

void CameraMotion::frame(const render::Bounds& bounds, float aspect) {
    m_camera.frame(bounds, aspect);
    m_isFollowing = true;
    m_hasFramed = m_hasFramed || !bounds.isEmpty();
}

void CameraMotion::show(const render::Bounds& bounds, float aspect) {
    frame(bounds, aspect);
    m_isFollowing = false;
}

void CameraMotion::follow(const render::Bounds& bounds, float aspect, double seconds) {
    if (!m_isFollowing || bounds.isEmpty()) {
        return;
    }
    if (!m_hasFramed) {
        frame(bounds, aspect);
        return;
    }
    render::Camera wanted = m_camera;
    wanted.frame(bounds, aspect);
    const auto share = static_cast<float>(1 - std::exp(-std::clamp(seconds, 0.0, 1.0) / kFollowSeconds));
    m_camera.target += share * (wanted.target - m_camera.target);
    if (wanted.distance > m_camera.distance || wanted.distance * kTooFar < m_camera.distance) {
        m_camera.distance += share * (wanted.distance - m_camera.distance);
    }
}

} // namespace posewire::gui
