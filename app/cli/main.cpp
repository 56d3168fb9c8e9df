// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/program.h"
#include "app/system/standard_streams.h"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

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

CommandLine::Parsed parse(CommandLine& line, int count, char** arguments) {
    const std::vector<std::string> texts = system::argumentsOf(count, arguments);
    std::vector<const char*> pointers;
    std::ranges::transform(texts, std::back_inserter(pointers), &std::string::c_str);
    return line.parse(static_cast<int>(pointers.size()), pointers.data());
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
    const CommandLine::Parsed parsed = parse(program.line, argumentCount, arguments);
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
