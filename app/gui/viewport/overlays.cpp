// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/overlays.h"

namespace posewire::gui {

void addOverlays(const Overlays& on, const OverlaySubject& subject, SceneFrame& frame) {
    for (const OverlayEntry& entry : kOverlayTable) {
        if (on.has(entry.overlay)) {
            entry.draw(subject, frame);
        }
    }
}

void addWay(const std::vector<glm::vec3>& places, const glm::vec4& ink, float width, SceneFrame& frame) {
    for (std::size_t i = 1; i < places.size(); ++i) {
        glm::vec4 faded = ink;
        faded.a *= static_cast<float>(i) / static_cast<float>(places.size());
        frame.lines.push_back({places[i - 1], places[i], faded, width});
    }
}

} // namespace posewire::gui
