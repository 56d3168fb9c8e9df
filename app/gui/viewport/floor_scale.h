// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene.h"

namespace posewire::gui {

/// Metres in the picture, once its camera and size are known: numbers along the axes x and y on the floor;
/// where an orthographic view looks along the floor, the floor as a line, with a rule along it and one that
/// gives heights. Numbers keep out of the figures.
void addFloorScale(SceneFrame& frame);

/// The least of 0.1, 0.2, 0.5, 1, 2, 5 … metres that takes at least `pixels` of a picture.
[[nodiscard]] double scaleStep(double metresPerPixel, double pixels);

} // namespace posewire::gui
