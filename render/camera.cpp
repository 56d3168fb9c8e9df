// SPDX-License-Identifier: MIT
#include "render/camera.h"

#include "render/mesh/finite.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/scalar_constants.hpp>

namespace posewire::render {
namespace {

constexpr float kLargestPitch = 1.55F;
constexpr float kNearestDistance = 0.2F;
constexpr float kFarthestDistance = 200.0F;
/// Room around what is framed.
constexpr float kFrameMargin = 1.06F;

/// Largest |x| and |y| of the box in the picture, as tangents, seen from `distance` before its centre.
glm::vec2 tangentExtent(const Camera& camera, const Bounds& bounds, float distance) {
    glm::vec2 extent{0.0F};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 offset = bounds.corner(corner) - bounds.centre();
        const float depth = camera.projection == Projection::Perspective
                                ? std::max(distance + glm::dot(offset, camera.forward()), 0.05F)
                                : distance;
        extent.x = std::max(extent.x, std::abs(glm::dot(offset, camera.right())) / depth);
        extent.y = std::max(extent.y, std::abs(glm::dot(offset, camera.up())) / depth);
    }
    return extent;
}

} // namespace

glm::vec3 Camera::forward() const {
    return {-std::cos(pitch) * std::cos(yaw), -std::cos(pitch) * std::sin(yaw), -std::sin(pitch)};
}

glm::vec3 Camera::right() const {
    return {-std::sin(yaw), std::cos(yaw), 0.0F};
}

glm::vec3 Camera::up() const {
    return glm::cross(right(), forward());
}

glm::vec3 Camera::eye() const {
    return target - distance * forward();
}

glm::mat4 Camera::view() const {
    return glm::lookAt(eye(), target, up());
}

glm::mat4 Camera::projectionMatrix(float aspect) const {
    const float far = distance + 100.0F;
    if (projection == Projection::Perspective) {
        return glm::perspective(verticalFov, aspect, std::clamp(0.02F * distance, 0.01F, 0.5F), far);
    }
    const float halfHeight = distance * std::tan(0.5F * verticalFov);
    return glm::ortho(-halfHeight * aspect, halfHeight * aspect, -halfHeight, halfHeight, -100.0F, far);
}

glm::mat4 Camera::viewProjection(float aspect) const {
    return projectionMatrix(aspect) * view();
}

void Camera::orbit(float yawDelta, float pitchDelta) {
    yaw = std::remainder(yaw + yawDelta, 2.0F * glm::pi<float>());
    pitch = std::clamp(pitch + pitchDelta, -kLargestPitch, kLargestPitch);
}

void Camera::pan(const glm::vec2& delta) {
    const float height = 2.0F * distance * std::tan(0.5F * verticalFov);
    target -= height * (delta.x * right() + delta.y * up());
}

void Camera::zoom(float factor) {
    if (factor > 0.0F) {
        distance = std::clamp(distance * factor, kNearestDistance, kFarthestDistance);
    }
}

void Camera::frame(const Bounds& bounds, float aspect) {
    if (bounds.isEmpty() || !isFinite(bounds.min) || !isFinite(bounds.max)) {
        return;
    }
    target = bounds.centre();
    const float tangent = std::tan(0.5F * verticalFov) / kFrameMargin;
    float nearest = kNearestDistance;
    float farthest = kFarthestDistance;
    for (int step = 0; step < 40; ++step) {
        const float middle = 0.5F * (nearest + farthest);
        const glm::vec2 extent = tangentExtent(*this, bounds, middle);
        const bool fits = extent.x <= tangent * aspect && extent.y <= tangent;
        (fits ? farthest : nearest) = middle;
    }
    distance = farthest;
}

Ray Camera::rayThrough(const glm::vec2& screen, float aspect) const {
    const float tangent = std::tan(0.5F * verticalFov);
    const glm::vec3 offset = tangent * (screen.x * aspect * right() + screen.y * up());
    if (projection == Projection::Perspective) {
        return {eye(), glm::normalize(forward() + offset)};
    }
    // Everything before and behind the eye is in an orthographic picture: start well before it.
    return {eye() + distance * offset - 100.0F * forward(), forward()};
}

std::optional<glm::vec2> Camera::project(const glm::vec3& point, float aspect) const {
    const glm::vec4 clip = viewProjection(aspect) * glm::vec4(point, 1.0F);
    if (!(clip.w > 1e-4F)) {
        return std::nullopt;
    }
    return glm::vec2(clip) / clip.w;
}

Camera facing(Camera camera, StandardView view) {
    constexpr float kHalfTurn = glm::pi<float>();
    switch (view) {
    case StandardView::Front:
        camera.yaw = 0.0F;
        break;
    case StandardView::Back:
        camera.yaw = kHalfTurn;
        break;
    case StandardView::Left:
        camera.yaw = 0.5F * kHalfTurn;
        break;
    case StandardView::Right:
        camera.yaw = -0.5F * kHalfTurn;
        break;
    case StandardView::Top:
        camera.yaw = kHalfTurn;
        camera.pitch = kLargestPitch;
        return camera;
    case StandardView::ThreeQuarter:
        camera.yaw = 0.45F;
        camera.pitch = 0.16F;
        return camera;
    }
    camera.pitch = 0.0F;
    return camera;
}

} // namespace posewire::render
