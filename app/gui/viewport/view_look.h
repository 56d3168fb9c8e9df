// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/camera_motion.h"
#include "app/gui/viewport/scene.h"

#include <vector>

namespace posewire::gui {

/// What the operator chose to see of a session, and from where.
struct ViewLook {
    AxesMode axes = AxesMode::Selected;
    Overlays overlays;
    bool hasScale = true; ///< metres on the floor
    Wardrobe wardrobe;
    CameraMotion motion;

    /// The frame at the cursor of the builder's session, for its width, height and ratio of pixels.
    /// `seconds`: since the frame before it, for a camera that follows.
    void fill(SceneBuilder& builder, double seconds, SceneFrame& frame);
};

/// About a figure, with room for flesh, feet and the label above.
[[nodiscard]] render::Bounds paddedBounds(const Figure& figure);
[[nodiscard]] std::vector<render::Bounds> boxesOf(const SceneFrame& frame);
/// Width by height.
[[nodiscard]] float aspectOf(const SceneFrame& frame);

} // namespace posewire::gui
