// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::system {

/// Keeps the computer awake, or lets it sleep again; its screen may go dark. Call it on one thread alone.
/// Elsewhere than on Windows this is left to the desktop.
void preventSleep(bool isNeeded);

} // namespace posewire::system
