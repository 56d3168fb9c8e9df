// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/view_look.h"

#include <QRect>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

void ViewLook::fill(SceneBuilder& builder, double seconds, SceneFrame& frame) {
    builder.setWardrobe(wardrobe);
    builder.build(axes, overlays, frame);
    aim(panes.motion(), seconds, frame);
}

void ViewLook::fillPanes(SceneBuilder& builder, double seconds, SceneFrame& frame) {
    builder.setWardrobe(wardrobe);
    builder.build(axes, overlays, frame);
    std::vector<SceneFrame> all(static_cast<std::size_t>(panes.count()), frame);
    const auto pixels = [&](int logical) {
        return static_cast<int>(std::lround(static_cast<float>(logical) * frame.pixelRatio));
    };
    for (int pane = 0; pane < panes.count(); ++pane) {
        SceneFrame& one = all[static_cast<std::size_t>(pane)];
        const QRect place = panes.place(pane);
        one.x = pixels(place.x());
        one.y = pixels(place.y());
        one.width = std::max(1, pixels(place.width()));
        one.height = std::max(1, pixels(place.height()));
        aim(panes.motionOf(pane), seconds, one);
    }
    frame.camera = panes.motion().camera();
    frame.panes = std::move(all);
}

bool ViewLook::isGliding() const {
    bool isAny = false;
    for (int pane = 0; pane < panes.count(); ++pane) {
        isAny = isAny || panes.motionOf(pane).isGliding();
    }
    return isAny;
}

void ViewLook::aim(CameraMotion& motion, double seconds, SceneFrame& frame) const {
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
