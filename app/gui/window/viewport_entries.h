// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"

#include <span>

namespace posewire::gui {

/// What the menus do in the viewport: camera, axes, overlays, and whose figure is selected.
[[nodiscard]] std::span<const ActionInfo> viewportEntries();

} // namespace posewire::gui
