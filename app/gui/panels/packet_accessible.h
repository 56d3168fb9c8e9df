// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::gui {

/// From now on screen readers find in a PacketView the rows that are in sight, with the titles of their
/// columns, and in each cell what it says at that moment. Rows out of sight, which may be tens of millions,
/// are not there until they are scrolled to.
void installPacketAccessible();

} // namespace posewire::gui
