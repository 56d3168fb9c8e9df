// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/program.h"

#include "app/cli/command.h"

#include <CLI/CLI.hpp>

#include <csignal>
#include <iostream>

namespace posewire::cli {
namespace {

/// Complaints that the parser words over several lines become one.
std::string oneLine(std::string text) {
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string chosenName(const CLI::App& program) {
    const auto chosen = program.get_subcommands();
    return "posewire-cli" + (chosen.empty() ? "" : " " + chosen.front()->get_name());
}

std::string wordingOf(const CLI::App& program, const CLI::ParseError& what) {
    const std::vector<std::string> unknown = program.remaining(true);
    return unknown.empty() ? oneLine(what.what()) : unknown.front() + " is not known here";
}

/// Help and version go to standard output with status 0; anything else is wrong usage.
ExitStatus answer(const CLI::App& program, const CLI::ParseError& what) {
    if (what.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
        return program.exit(what, std::cout, std::cerr) == 0 ? ExitStatus::Fine : ExitStatus::Unusable;
    }
    const std::string name = chosenName(program);
    std::cerr << name << ": " << wordingOf(program, what) << "; see " << name << " --help\n";
    return ExitStatus::Unusable;
}

ExitStatus run(const Command& command) {
    Output out = Output::standard();
    const std::string name = "posewire-cli " + command.parser->get_name() + ": ";
    Console console{out, [&](const std::string& line) { std::cerr << name << line << '\n'; }};
    const ExitStatus status = command.run(console);
    if (const auto finished = out.finish(); !finished) {
        console.complain(finished.error());
        return ExitStatus::Unusable;
    }
    return status;
}

} // namespace

int runProgram(int argumentCount, const char* const* arguments) {
#ifdef SIGPIPE
    // A reader that has seen enough closes the pipe; the write that fails then ends the program in order.
    std::signal(SIGPIPE, SIG_IGN);
#endif
    std::ios::sync_with_stdio(false);
    CLI::App program("Decodes, encodes, sends and watches MXTP motion-capture datagrams.", "posewire-cli");
    program.set_version_flag("--version", "posewire-cli " POSEWIRE_VERSION, "Print the version and exit");
    program.footer("Exit status: 0 fine; 1 the input had faults, or a limit was exceeded; 2 wrong usage, or "
                   "a file or port "
                   "that cannot be opened.");
    const std::vector<Command> commands{addDecodeCommand(program), addEncodeCommand(program),
                                        addSendCommand(program),   addMonitorCommand(program),
                                        addReportCommand(program), addReferenceCommand(program)};
    try {
        program.parse(argumentCount, arguments);
    } catch (const CLI::ParseError& what) {
        return static_cast<int>(answer(program, what));
    }
    for (const Command& command : commands) {
        if (command.parser->parsed()) {
            return static_cast<int>(run(command));
        }
    }
    std::cerr << "posewire-cli: a command is needed; see posewire-cli --help\n";
    return static_cast<int>(ExitStatus::Unusable);
}

} // namespace posewire::cli
