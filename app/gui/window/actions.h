// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/panel.h"

#include <vector>

namespace posewire::gui {

/// An entry of the window's menus and who carries it out.
struct MenuEntry {
    const ActionInfo* action;
    const PanelInfo* panel; ///< null for the window itself
};

/// All entries in the order of the menus. The window's own are in actions.cpp, which also says where in each
/// menu those of the panels go.
[[nodiscard]] std::vector<MenuEntry> menuEntries();

} // namespace posewire::gui
