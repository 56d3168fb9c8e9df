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

} // namespace posewire::gui
