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
    /// The same for all panes of a view of that size, in logical pixels: what is in them is built once.
    void fillPanes(SceneBuilder& builder, double seconds, const QSize& view, SceneFrame& frame);

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

} // namespace posewire::gui
