// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/command.h"

#include <vector>

namespace posewire::cli {

/// posewire-cli as a whole: its command line, and the commands that were declared there.
struct Program {
    CommandLine line;
    std::vector<Command> commands;

    Program();
};

} // namespace posewire::cli
