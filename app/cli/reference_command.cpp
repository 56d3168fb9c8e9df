// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "core/filter/filter_reference.h"
#include "core/wire/reference.h"

#include <CLI/CLI.hpp>

namespace posewire::cli {

Command addReferenceCommand(CLI::App& program) {
    CLI::App* parser = program.add_subcommand("reference", "Print the protocol reference in Markdown");
    auto isFilterWanted = std::make_shared<bool>(false);
    parser->add_flag("--filter", *isFilterWanted, "the language of decode --filter instead");
    return {parser, [isFilterWanted](Console& console) {
                console.out.write(*isFilterWanted ? filter::filterReference() : wire::protocolReference());
                return ExitStatus::Fine;
            }};
}

} // namespace posewire::cli
