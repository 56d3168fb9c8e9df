// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

class QPalette;

namespace posewire::gui {

/// What a choice means on a desktop with that palette. One whose texts are black on white, or white on black,
/// wants high contrast, and gets it where its theme is followed.
[[nodiscard]] Theme themeFor(ThemeChoice choice, const QPalette& desktop);

} // namespace posewire::gui
