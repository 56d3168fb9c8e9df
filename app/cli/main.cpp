// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/system/standard_streams.h"

#include <algorithm>
#include <iostream>
#include <string>

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

} // namespace
} // namespace posewire::cli

int main(int argumentCount, char** arguments) {
    using namespace posewire;
    using namespace posewire::cli;
    system::leaveFailedWritesToTheWriter();
    system::prepareStandardStreams();
    std::ios::sync_with_stdio(false);
    Program program;
    const auto parsed = program.line.parse(system::argumentsOf(argumentCount, arguments));
    if (!parsed) {
        return usage::end(parsed.error());
    }
    return static_cast<int>(run(*std::ranges::find(program.commands, *parsed, &Command::name)));
}
