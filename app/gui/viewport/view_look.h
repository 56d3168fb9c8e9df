// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene.h"
#include "app/gui/viewport/view_panes.h"

#include <vector>

namespace posewire::gui {

/// What the operator chose to see of a session, and from where.
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

    /// Whether a camera is on its way to what it follows.
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
