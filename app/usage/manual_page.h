// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/usage/usage.h"

#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace posewire::usage {

/// What a manual page says about itself.
struct PageFacts {
    std::string version;
    std::string date; ///< of the release, "2026-11-23"
};

/// The manual page in roff. `frame` is the page with prose of its own and, where the options go, the lines
/// @SYNOPSIS@, @OPTIONS@ and, for a program with commands, @COMMANDS@; @VERSION@ and @DATE@ in its first
/// line. The error names what the frame lacks.
[[nodiscard]] tl::expected<std::string, std::string>
manualPage(const Program& program, std::string_view frame, const PageFacts& facts);

} // namespace posewire::usage
