// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "core/export/protocol_reference.h"
#include "core/filter/filter.h"

#include <memory>

namespace posewire::cli {

Command addReferenceCommand(CommandLine& program) {
    Arguments arguments = program.addCommand("reference", "Print the protocol reference in Markdown");
    auto isFilterWanted = std::make_shared<bool>(false);
    arguments.flag("--filter", *isFilterWanted, "print the language of decode --filter instead");
    return {"reference", [isFilterWanted](Console& console) {
                console.out.write(*isFilterWanted ? filter::filterReference()
                                                  : exporting::protocolReference());
                return ExitStatus::Fine;
            }};
}

} // namespace posewire::cli
