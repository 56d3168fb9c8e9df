// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_options.h"

#include <CLI/CLI.hpp>

namespace posewire::cli {

Command addReportCommand(CLI::App& program) {
    auto options = std::make_shared<MonitorOptions>();
    options->isQuiet = true;
    CLI::App* parser = program.add_subcommand(
        "report",
        "Write a report on a recording as HTML: what was received, what not, and whose fault it was");
    parser->add_option("FILE", options->file, "pcap, pcapng, or datagrams back to back; - for standard input")
        ->required();
    parser->add_option("-o,--output", options->report, "the HTML file; - for standard output")
        ->type_name("FILE")
        ->required();
    CLI::Option* from =
        parser->add_option("--from", options->fromSeconds, "begin so many seconds after the first datagram");
    CLI::Option* to =
        parser->add_option("--to", options->toSeconds, "end so many seconds after the first datagram");
    for (CLI::Option* option : {from, to}) {
        option->type_name("SECONDS")->check(CLI::NonNegativeNumber);
    }
    return {parser, [options](Console& console) {
                if (options->fromSeconds && options->toSeconds &&
                    *options->fromSeconds >= *options->toSeconds) {
                    console.complain("--from must be before --to");
                    return ExitStatus::Unusable;
                }
                return monitorFile(*options, console);
            }};
}

} // namespace posewire::cli
