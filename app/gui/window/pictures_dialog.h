// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/playback.h"
#include "app/gui/viewport/viewport_widget.h"

namespace posewire::gui {

/// Asks which pictures of the viewport to write as PNG, of this moment or a series of a time, and writes them
/// until it is closed. The window shows the moments as they are drawn; what is received goes on meanwhile.
void showPicturesDialog(const Commands& commands, Playback& playback, const ComparisonState& comparison,
                        const ViewportWidget& viewport, QWidget* parent);

} // namespace posewire::gui
