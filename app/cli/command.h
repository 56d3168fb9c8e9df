// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/input_output.h"
#include "app/usage/command_line.h"
#include "core/log/byte_io.h"

#include <functional>
#include <string>
#include <vector>

namespace posewire::cli {

using usage::Arguments;
using usage::CommandLine;
using usage::DeclaredOption;

enum class ExitStatus : int {
    Fine = 0,
    Faults = 1,   ///< the input had faults, or a threshold was exceeded
    Unusable = 2, ///< wrong usage, or the input or output could not be opened
};

[[nodiscard]] constexpr ExitStatus worse(ExitStatus a, ExitStatus b) {
    return a < b ? b : a;
}

/// Where a command writes: results to one place, complaints to another.
struct Console {
    Output& out;
    std::function<void(const std::string&)> complain; ///< one line: what, where, what to do

    [[nodiscard]] ExitStatus unusable(const std::string& complaint) const {
        complain(complaint);
        return ExitStatus::Unusable;
    }
};

/// Says what is wrong, if anything is; a reader that wants no more is no fault.
[[nodiscard]] ExitStatus readingStatus(const tl::expected<void, log::FileError>& result,
                                       const Console& console);
/// Also says what the input holds if it has nothing of ours.
[[nodiscard]] ExitStatus readingStatus(const tl::expected<void, log::FileError>& result,
                                       const log::FileContents& contents, const std::string& name,
                                       const Console& console);

/// One command of the program: its name, and what it does once the command line is parsed.
struct Command {
    std::string name;
    std::function<ExitStatus(Console&)> run;
};

/// `--up`: declared about all senders.
DeclaredOption addUp(usage::Arguments arguments, std::string& up);

/// `--force` and `--mode`, of a command that writes files.
void addOutputs(usage::Arguments arguments, bool& replaces);

Command addDecodeCommand(CommandLine& program);
Command addEncodeCommand(CommandLine& program);
Command addExportCommand(CommandLine& program);
Command addFollowCommand(CommandLine& program);
Command addMonitorCommand(CommandLine& program);
Command addOutletCommand(CommandLine& program);
Command addProbeCommand(CommandLine& program);
Command addQueryCommand(CommandLine& program);
Command addReferenceCommand(CommandLine& program);
Command addReportCommand(CommandLine& program);
Command addSendCommand(CommandLine& program);
Command addStageCommand(CommandLine& program);

/// posewire-cli as a whole: its command line, and the commands that were declared there.
struct Program {
    CommandLine line;
    std::vector<Command> commands;

    Program();
};

} // namespace posewire::cli
