// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/camera_motion.h"
#include "app/gui/viewport/scene.h"

#include <QPointF>

#include <array>
#include <vector>

namespace posewire::gui {

/// The views that the viewport is split into: one, two side by side or four, each with a camera of its own.
/// One is the active: what the operator asks of the camera is of that one.
class ViewPanes {
public:
    static constexpr int kMost = 4;

    [[nodiscard]] int count() const { return m_count; }
    [[nodiscard]] bool isSplit() const { return m_count > 1; }
    [[nodiscard]] int active() const { return m_active; }

    /// Logical pixels of all panes together.
    void resize(const QSize& view) { m_view = view; }

    /// 1, 2 or 4. Views that were never shown look level from the front, the left and the top, about
    /// `heading` (radians) as a character's.
    void split(int count, float heading);
    void activate(int pane) { m_active = std::clamp(pane, 0, m_count - 1); }

    /// The active one's.
    [[nodiscard]] CameraMotion& motion() { return motionOf(m_active); }
    [[nodiscard]] const CameraMotion& motion() const { return m_motions[static_cast<std::size_t>(m_active)]; }
    [[nodiscard]] CameraMotion& motionOf(int pane) { return m_motions[static_cast<std::size_t>(pane)]; }
    [[nodiscard]] const CameraMotion& motionOf(int pane) const {
        return m_motions[static_cast<std::size_t>(pane)];
    }

    [[nodiscard]] QRect place(int pane) const;
    /// The active one's place, and its width by its height.
    [[nodiscard]] QRect place() const { return place(m_active); }
    [[nodiscard]] float aspect() const;
    /// The one there; the active one if the point is between two.
    [[nodiscard]] int paneAt(const QPointF& point) const;

    [[nodiscard]] QJsonObject state() const;
    /// What makes no sense stays as it is.
    void restoreState(const QJsonObject& state);

    /// "Front", or the projection if the view was turned by hand.
    [[nodiscard]] QString name(int pane) const;

private:
    std::array<CameraMotion, kMost> m_motions;
    std::array<bool, kMost> m_wasShown{true};
    QSize m_view;
    int m_count = 1;
    int m_active = 0;
};

struct ViewLook {
    AxesMode axes = AxesMode::Selected;
    Overlays overlays;
    bool hasScale = true; ///< metres on the floor
    Wardrobe wardrobe;
    ViewPanes panes;

    /// The frame at the cursor of the builder's session, for its width, height and ratio of pixels.
    /// `seconds`: since the frame before it, for a camera that follows.
    void fill(SceneBuilder& builder, double seconds, SceneFrame& frame);
    /// The same for all panes: what is in them is built once.
    void fillPanes(SceneBuilder& builder, double seconds, SceneFrame& frame);

    [[nodiscard]] bool isGliding() const;

private:
    void aim(CameraMotion& motion, double seconds, SceneFrame& frame) const;
};

/// About a figure, with room for flesh, feet and the label above.
[[nodiscard]] render::Bounds paddedBounds(const Figure& figure);
[[nodiscard]] std::vector<render::Bounds> boxesOf(const SceneFrame& frame);
/// Width by height.
[[nodiscard]] float aspectOf(const SceneFrame& frame);

/// Metres in the picture, once its camera and size are known: numbers along the axes x and y on the floor;
/// where an orthographic view looks along the floor, the floor as a line, with a rule along it and one that
/// gives heights. Numbers keep out of the figures.
void addFloorScale(SceneFrame& frame);

/// The least of 0.1, 0.2, 0.5, 1, 2, 5 … metres that takes at least `pixels` of a picture.
[[nodiscard]] double scaleStep(double metresPerPixel, double pixels);

} // namespace posewire::gui
