// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/view_look.h"

#include "app/gui/viewport/floor_scale.h"

namespace posewire::gui {

void ViewLook::fill(SceneBuilder& builder, double seconds, SceneFrame& frame) {
    builder.setWardrobe(wardrobe);
    builder.build(axes, overlays, frame);
    motion.follow(boxesOf(frame), aspectOf(frame), seconds);
    frame.camera = motion.camera();
    sizeAxes(frame);
    if (hasScale) {
        addFloorScale(frame);
    }
}

render::Bounds paddedBounds(const Figure& figure) {
    constexpr float kMargin = 0.22F; // metres
    render::Bounds bounds = figure.bounds;
    bounds.min -= glm::vec3(kMargin, kMargin, 0.5F * kMargin);
    bounds.max += glm::vec3(kMargin, kMargin, 1.6F * kMargin);
    return bounds;
}

std::vector<render::Bounds> boxesOf(const SceneFrame& frame) {
    std::vector<render::Bounds> boxes;
    for (const Figure& figure : frame.figures) {
        if (!figure.bounds.isEmpty()) {
            boxes.push_back(paddedBounds(figure));
        }
    }
    return boxes;
}

float aspectOf(const SceneFrame& frame) {
    return static_cast<float>(frame.width) / static_cast<float>(frame.height);
}

} // namespace posewire::gui
