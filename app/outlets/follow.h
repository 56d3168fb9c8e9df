// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/outlets/pose_outlet.h"

#include <functional>
#include <string>

namespace posewire::outlets {

/// A line of JSON for each pose (see exporting::poseLine), to all who connect to a place as net::LineServer
/// has them.
[[nodiscard]] MakeWriter followAt(const std::string& place);

/// The same into one place; `write` returns whether there was room for the line.
[[nodiscard]] MakeWriter followInto(std::function<bool(std::string line)> write);

} // namespace posewire::outlets
