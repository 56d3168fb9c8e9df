// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/usage/usage.h"

#include <string>

namespace posewire::usage {

/// The script by which bash completes commands, options and their values: a whole file, for the folder where
/// bash looks for completions.
[[nodiscard]] std::string bashCompletion(const Program& program);

} // namespace posewire::usage
