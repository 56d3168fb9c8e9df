// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/usage/usage.h"

#include <string>
#include <string_view>

#include <tl/expected.hpp>

/// Manual pages and shell completions, generated from the options that the programs declare.
namespace posewire::manual {

struct PageFacts {
    std::string version;
    std::string date; ///< of the release, "2026-11-23"
};

/// The manual page in roff. `frame` is the page with prose of its own and, for the options, the lines
/// @SYNOPSIS@, @OPTIONS@ and, for a program with commands, @COMMANDS@; @VERSION@ and @DATE@ in its first
/// line. The error names what the frame lacks.
[[nodiscard]] tl::expected<std::string, std::string>
manualPage(const usage::Program& program, std::string_view frame, const PageFacts& facts);

/// The script by which bash completes commands, options and their values: a whole file, for the folder where
/// bash looks for completions.
[[nodiscard]] std::string bashCompletion(const usage::Program& program);

} // namespace posewire::manual
