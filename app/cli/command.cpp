// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"

#include "app/usage/usage.h"
#include "core/log/output_file.h"
#include "core/model/accounting/other_formats.h"

#include <QtGlobal>

namespace posewire::cli {

Program::Program()
    : line(
          "posewire-cli", "Decodes, encodes, sends, watches and exports MXTP motion-capture datagrams.",
          [] { return "posewire-cli " + std::string(usage::version()) + "\nQt " + qVersion(); },
          "Exit status: 0 fine; 1 the input had faults, or a limit was exceeded; 2 wrong usage, or "
          "a file or port that cannot be opened."),
      commands{addDecodeCommand(line),    addEncodeCommand(line),  addQueryCommand(line),
               addSendCommand(line),      addMonitorCommand(line), addFollowCommand(line),
               addOutletCommand(line),    addReportCommand(line),  addExportCommand(line),
               addReferenceCommand(line), addProbeCommand(line),   addStageCommand(line)} {}

ExitStatus readingStatus(const tl::expected<void, log::FileError>& result, const Console& console) {
    using Kind = log::FileError::Kind;
    if (result || result.error().kind == Kind::Cancelled) {
        return ExitStatus::Fine;
    }
    console.complain(result.error().text);
    return result.error().leavesABeginning() ? ExitStatus::Faults : ExitStatus::Unusable;
}

ExitStatus readingStatus(const tl::expected<void, log::FileError>& result, const log::FileContents& contents,
                         const std::string& name, const Console& console) {
    ExitStatus status = readingStatus(result, console);
    const bool isRead = result || result.error().leavesABeginning();
    if (const std::string other = model::otherContents(contents, name); isRead && !other.empty()) {
        console.complain(name + ": " + other);
        status = worse(status, contents.skipped > contents.bytes ? ExitStatus::Faults : ExitStatus::Fine);
    }
    return status;
}

DeclaredOption addUp(usage::Arguments arguments, std::string& up) {
    return arguments.choice("--up auto|y|z", up,
                            "axis that is up in types 02, 21 and 22, instead of what poses look like");
}

void addOutputs(usage::Arguments arguments, bool& replaces) {
    arguments.force(replaces);
    arguments.read("--mode OCTAL", log::setFileMode,
                   "permissions of files that are made, such as 0640 for a shared folder; 0600 by default");
}

} // namespace posewire::cli
