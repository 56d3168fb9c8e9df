// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace posewire::gui {

class MainWindow;

/// One entry of a menu. To add one: a row in actions.cpp.
struct ActionInfo {
    const char* id;       ///< object name, fixed for scripts; empty for a line between entries
    const char* menu;     ///< "File", "View/Theme"; translated in context "Action", as `text`
    const char* text;     ///< with the letter to press after &
    const char* shortcut; ///< portable text, empty for none
    bool isCheckable = false;
    void (*run)(MainWindow& window) = nullptr;
    bool (*isOn)(MainWindow& window) = nullptr; ///< asked when its menu opens, where it is known elsewhere
};

[[nodiscard]] std::span<const ActionInfo> actionTable();

} // namespace posewire::gui
