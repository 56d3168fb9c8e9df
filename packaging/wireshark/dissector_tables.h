// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace posewire::wireshark {

/// The layouts, names and texts of core as tables in Lua, for the dissector to walk. One for each
/// declaration: a layout added to core/wire is in them.
[[nodiscard]] std::string dissectorTables();

} // namespace posewire::wireshark
