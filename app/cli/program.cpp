// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/program.h"

#include "app/usage/version.h"

#include <QtGlobal>

namespace posewire::cli {
namespace {

/// The first line is the program's; a report of a fault needs the others.
std::string versionText() {
    return "posewire-cli " + std::string(usage::version()) + "\nQt " + qVersion();
}

} // namespace

Program::Program()
    : line("posewire-cli", "Decodes, encodes, sends, watches and exports MXTP motion-capture datagrams.",
           versionText(),
           "Exit status: 0 fine; 1 the input had faults, or a limit was exceeded; 2 wrong usage, or "
           "a file or port that cannot be opened."),
      commands{addDecodeCommand(line),   addEncodeCommand(line), addSendCommand(line),
               addMonitorCommand(line),  addReportCommand(line), addExportCommand(line),
               addReferenceCommand(line)} {}

} // namespace posewire::cli
