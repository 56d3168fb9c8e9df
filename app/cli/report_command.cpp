// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_options.h"

#include "app/cli/command.h"

#include <memory>

namespace posewire::cli {

Command addReportCommand(CommandLine& program) {
    auto options = std::make_shared<MonitorOptions>();
    options->isQuiet = true;
    Arguments arguments = program.addCommand(
        "report",
        "Write a report on a recording as HTML: what was received, what not, and whose fault it was");
    arguments.add("FILE", options->file, "pcap, pcapng, or datagrams back to back; - for standard input")
        .required();
    arguments.add("-o,--output", options->report, "the HTML file; - for standard output")
        .form("FILE")
        .required();
    arguments.add("--from", options->fromSeconds, "begin this many seconds after the first datagram")
        .form("SECONDS")
        .notNegative();
    arguments.add("--to", options->toSeconds, "end this many seconds after the first datagram")
        .form("SECONDS")
        .notNegative();
    return {"report", [options](Console& console) {
                if (options->fromSeconds && options->toSeconds &&
                    *options->fromSeconds >= *options->toSeconds) {
                    console.complain("--from must be before --to");
                    return ExitStatus::Unusable;
                }
                return monitorFile(*options, console);
            }};
}

} // namespace posewire::cli
