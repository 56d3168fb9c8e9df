// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::gui {

class MainWindow;

/// Opens a box with the version, the licences and the libraries of this build.
void showAbout(MainWindow& window);

} // namespace posewire::gui
