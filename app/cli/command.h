// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/command_line.h"
#include "app/cli/output.h"

#include <functional>
#include <string>

namespace posewire::cli {

/// What the exit status says; the same for every command.
enum class ExitStatus : int {
    Fine = 0,
    Faults = 1,   ///< the input had faults, or a threshold was exceeded
    Unusable = 2, ///< wrong usage, or the input or output could not be opened
};

/// The worse of the two.
[[nodiscard]] constexpr ExitStatus worse(ExitStatus a, ExitStatus b) {
    return a < b ? b : a;
}

/// Where a command writes: results to one place, complaints to another.
struct Console {
    Output& out;
    std::function<void(const std::string&)> complain; ///< one line: what, where, what to do
};

/// One command of the program: its name, and what it does once the command line is parsed.
struct Command {
    std::string name;
    std::function<ExitStatus(Console&)> run;
};

Command addDecodeCommand(CommandLine& program);
Command addEncodeCommand(CommandLine& program);
Command addMonitorCommand(CommandLine& program);
Command addReferenceCommand(CommandLine& program);
Command addReportCommand(CommandLine& program);
Command addSendCommand(CommandLine& program);

} // namespace posewire::cli
