// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace posewire::gui {

class MainWindow;

/// Sections of the dialog, in its order.
enum class PreferencesSection : std::uint8_t { Appearance, Viewport, Lists, Recording, History, Thresholds };

/// Shows all choices that are kept from one run to the next, to be found by their words. Each applies at
/// once, except for the history: another size forgets packets, so it applies when the dialog closes. Gives
/// the keyboard to the first field of the section, or to the search if that is Appearance.
void openPreferences(MainWindow& window, PreferencesSection section);

} // namespace posewire::gui
