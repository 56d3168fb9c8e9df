// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/program.h"

#include <algorithm>
#include <csignal>
#include <iostream>

#include <fcntl.h>

namespace posewire::cli {
namespace {

ExitStatus run(const Command& command) {
    Output out = Output::standard();
    const std::string name = "posewire-cli " + command.name + ": ";
    Console console{out, [&](const std::string& line) { std::cerr << name << line << '\n'; }};
    const ExitStatus status = command.run(console);
    if (const auto finished = out.finish(); !finished) {
        return console.unusable(finished.error());
    }
    return status;
}

/// Where one of the three is closed, a file that is opened would take its place, and be written to as that.
void openStandardStreams() {
    for (int number = 0; number < 3; ++number) {
        if (::fcntl(number, F_GETFD) < 0) {
            static_cast<void>(::open("/dev/null", O_RDWR));
        }
    }
}

} // namespace
} // namespace posewire::cli

int main(int argumentCount, char** arguments) {
    using namespace posewire::cli;
    // Where the reader closes the pipe, or a file may not grow, the failed write says so in good order.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    openStandardStreams();
    std::ios::sync_with_stdio(false);
    Program program;
    const CommandLine::Parsed parsed = program.line.parse(argumentCount, arguments);
    if (parsed.kind == CommandLine::Parsed::Kind::Answer) {
        std::cout << parsed.text;
        return static_cast<int>(ExitStatus::Fine);
    }
    const auto chosen = std::ranges::find(program.commands, parsed.text, &Command::name);
    if (parsed.kind == CommandLine::Parsed::Kind::Command && chosen != program.commands.end()) {
        return static_cast<int>(run(*chosen));
    }
    std::cerr << parsed.text << '\n';
    return static_cast<int>(ExitStatus::Unusable);
}
