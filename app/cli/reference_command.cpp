// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "core/wire/reference.h"

#include <CLI/CLI.hpp>

namespace posewire::cli {

Command addReferenceCommand(CLI::App& program) {
    CLI::App* parser = program.add_subcommand("reference", "Print the protocol reference in Markdown");
    return {parser, [](Console& console) {
                console.out.write(wire::protocolReference());
                return ExitStatus::Fine;
            }};
}

} // namespace posewire::cli
