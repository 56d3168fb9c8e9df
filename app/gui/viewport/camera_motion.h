// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "render/camera.h"

#include <QJsonObject>
#include <QPointF>
#include <QSizeF>

#include <limits>
#include <optional>
#include <span>

namespace posewire::gui {

/// The operator's camera: what the pointer does to it, and keeping moving characters in the picture until the
/// operator pans or zooms.
class CameraMotion {
public:
    [[nodiscard]] const render::Camera& camera() const { return m_camera; }
    [[nodiscard]] bool isFollowing() const { return m_isFollowing; }
    /// On its way to where what it follows is.
    [[nodiscard]] bool isGliding() const { return m_isFollowing && m_isGliding; }
    /// Looks from there; one that follows moves to the first characters it is given, and looks the same way.
    void restore(const render::Camera& camera, bool isFollowing,
                 std::optional<render::StandardView> standardView = {}) {
        m_camera = camera;
        m_isFollowing = isFollowing;
        m_standardView = standardView;
        m_framed = 0;
    }
    /// That it was turned to, until it is turned by hand.
    [[nodiscard]] std::optional<render::StandardView> standardView() const { return m_standardView; }

    /// Pointer movements and positions in logical pixels of a view of the given size.
    void orbit(const QPointF& movement);
    void pan(const QPointF& movement, const QSizeF& view);
    /// Towards what is under the pointer; steps of a mouse wheel, positive comes closer.
    void zoom(double steps, const QPointF& pointer, const QSizeF& view);

    void face(render::StandardView view) {
        m_camera = render::facing(m_camera, view);
        m_standardView = view;
    }
    /// About the vertical, radians.
    void turn(float yaw) { m_camera.orbit(yaw, 0); }
    void setProjection(render::Projection projection) { m_camera.projection = projection; }

    /// Shows all boxes at once, and keeps showing what follow() is given. Without boxes nothing changes.
    void frame(std::span<const render::Bounds> boxes, float aspect);
    void show(const render::Bounds& box, float aspect);
    /// Shows the first boxes, and in a picture of another shape all, at once. From then on it holds still as
    /// long as all are well in the picture, and glides to where they are when they are not; after infinite
    /// `seconds`, as between two moments of a recording, it is there. Nothing after a pan or zoom.
    void follow(std::span<const render::Bounds> boxes, float aspect, double seconds);

private:
    [[nodiscard]] bool isHeld(std::span<const render::Bounds> boxes, float aspect) const;

    render::Camera m_camera;
    std::optional<render::StandardView> m_standardView;
    bool m_isFollowing = true;
    float m_framed = 0; ///< in a picture of that aspect
    bool m_isGliding = false;
};

/// The camera moved, not turned, so that the boxes fill the picture and are in its middle; unchanged
/// without boxes.
[[nodiscard]] render::Camera fitted(render::Camera camera, std::span<const render::Bounds> boxes,
                                    float aspect);

[[nodiscard]] QJsonObject stateOf(const CameraMotion& motion);
/// What is missing or makes no sense stays as it is.
void restore(CameraMotion& motion, const QJsonObject& state);

/// The part of a picture that boxes take, −1 … 1 with y up, by those of their corners that are before the
/// eye.
struct ScreenBox {
    glm::vec2 least{std::numeric_limits<float>::max()};
    glm::vec2 most{std::numeric_limits<float>::lowest()};
    bool isAllInFront = true;
};
[[nodiscard]] ScreenBox screenBox(const render::Camera& camera, std::span<const render::Bounds> boxes,
                                  float aspect);

/// Width by height.
[[nodiscard]] float aspectOf(const QSizeF& view);
/// −1 … 1, y up.
[[nodiscard]] glm::vec2 screenPoint(const QPointF& pointer, const QSizeF& view);
[[nodiscard]] QPointF pointerAt(const glm::vec2& screen, const QSizeF& view);

} // namespace posewire::gui
