// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::gui {

/// False while all windows of the program are minimised, or covered by others as far as the system reports
/// that: what is drawn is for no one. True where there is no window.
[[nodiscard]] bool isAnyWindowInSight();

} // namespace posewire::gui
