// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/outlets/pose_outlet.h"

#include <functional>
#include <string>

namespace posewire::outlets {

/// A line of JSON for each pose (see exporting::poseLine), to all who connect to a place as net::LineServer
/// has them.
[[nodiscard]] MakeWriter followAt(const OutletChoice& choice);

/// Passes these lines to `write`, which returns false if it has no room for one.
[[nodiscard]] MakeWriter followInto(std::function<bool(std::string line)> write);

} // namespace posewire::outlets
