// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/usage/usage.h"

#include <string>

namespace posewire::usage {

/// Scripts by which a shell completes commands, options and their values. Each is a whole file, for the
/// folder where its shell looks for completions.
[[nodiscard]] std::string bashCompletion(const Program& program);
[[nodiscard]] std::string fishCompletion(const Program& program);
[[nodiscard]] std::string zshCompletion(const Program& program);

} // namespace posewire::usage
