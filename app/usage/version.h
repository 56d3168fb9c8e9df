// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace posewire::usage {

/// The version of both programs, "0.1.0": that of the project in the topmost CMakeLists.txt.
[[nodiscard]] std::string_view version();

} // namespace posewire::usage
