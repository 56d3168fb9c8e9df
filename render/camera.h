// SPDX-License-Identifier: MIT
#pragma once

#include "render/bounds.h"

#include <optional>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace posewire::render {

struct Ray {
    glm::vec3 origin{0.0F};
    /// Unit length.
    glm::vec3 direction{0.0F, 0.0F, -1.0F};
};

enum class Projection { Perspective, Orthographic };

/// Orbits a target in a Z-up world: yaw 0 looks at the target from +x, yaw 90° from +y; a positive pitch
/// looks down. Metres and radians. Screen points are in normalised device coordinates: x right, y up, −1 … 1.
struct Camera {
    glm::vec3 target{0.0F, 0.0F, 0.9F};
    float yaw = 0.45F;
    float pitch = 0.16F;
    float distance = 5.0F;
    float verticalFov = 0.49F;
    Projection projection = Projection::Perspective;

    bool operator==(const Camera&) const = default;

    glm::vec3 eye() const;
    /// Unit vectors of the picture: where it looks, its right, its up.
    glm::vec3 forward() const;
    glm::vec3 right() const;
    glm::vec3 up() const;

    glm::mat4 view() const;
    /// `aspect` is width / height. An orthographic picture shows what the perspective one shows at the
    /// target.
    glm::mat4 projectionMatrix(float aspect) const;
    glm::mat4 viewProjection(float aspect) const;

    /// Turns about the target; the pitch stays short of straight up and straight down.
    void orbit(float yawDelta, float pitchDelta);
    /// Moves the target so that what is at its depth follows the pointer. Fractions of the picture's height,
    /// y up.
    void pan(const glm::vec2& delta);
    /// Multiplies the distance, within 0.2 m and 200 m. Less than 1 comes closer.
    void zoom(float factor);
    /// Shows the whole box without turning. An empty or not finite box changes nothing.
    void frame(const Bounds& bounds, float aspect);

    Ray rayThrough(const glm::vec2& screen, float aspect) const;
    /// Where a point appears, or nothing where it is behind the eye.
    std::optional<glm::vec2> project(const glm::vec3& point, float aspect) const;
};

/// Standard views keep target, distance and projection.
enum class StandardView { Front, Back, Left, Right, Top, ThreeQuarter };
Camera facing(Camera camera, StandardView view);

} // namespace posewire::render
