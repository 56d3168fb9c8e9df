// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_options.h"

#include <CLI/CLI.hpp>

namespace posewire::cli {
namespace {

CLI::Option* addPlace(CLI::App& parser, const std::string& name, std::vector<std::string>& texts,
                      const std::string& what) {
    return parser.add_option(name, texts, what + "; may be given several times")
        ->expected(1)
        ->take_all()
        ->group("Where from");
}

void addPlaces(CLI::App& parser, MonitorOptions& options) {
    CLI::Option* file = parser.add_option("FILE", options.file,
                                          "a recording (pcap, pcapng, or datagrams back to back; - for "
                                          "standard input) instead of the network: as "
                                          "fast as it goes, with its own stamps");
    addPlace(parser, "--udp", options.udp, "listen at [ADDRESS:]PORT (default 9763)")->excludes(file);
    addPlace(parser, "--multicast", options.multicast, "join the group GROUP at the UDP ports")
        ->excludes(file);
    addPlace(parser, "--tcp-listen", options.tcpListen, "wait at [ADDRESS:]PORT for MVN to connect")
        ->excludes(file);
    addPlace(parser, "--tcp", options.tcp, "connect to HOST:PORT, again and again")->excludes(file);
}

void addLimits(CLI::App& parser, Limits& limits) {
    const auto add = [&](const std::string& name, std::optional<double>& limit, const std::string& what) {
        parser.add_option(name, limit, what)
            ->check(CLI::NonNegativeNumber)
            ->group("Limits (of each stream; where one is exceeded the exit status is 1)");
    };
    add("--max-loss", limits.lossPercent, "samples lost or incomplete, percent");
    add("--max-jitter", limits.jitterMs, "jitter as in RFC 3550, milliseconds");
    add("--max-gap", limits.gapMs, "time between successive samples, milliseconds");
}

} // namespace

Command addMonitorCommand(CLI::App& program) {
    auto options = std::make_shared<MonitorOptions>();
    CLI::App* parser = program.add_subcommand(
        "monitor", "Watch streams: rate, loss, duplicates, order, jitter, gaps; record them; keep limits");
    addPlaces(*parser, *options);
    parser
        ->add_option("--duration", options->durationSeconds,
                     "stop after so many seconds; 0: when interrupted, or at the end of FILE")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    parser->add_flag("--json", options->asJson, "one report at the end instead of a live table");
    parser->add_option("--interval", options->intervalSeconds, "seconds between two tables")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    parser->add_option("--record", options->record, "write everything received to FILE as pcapng");
    parser->add_option("--report", options->report,
                       "write a report to FILE as HTML: what was received, what not, and whose fault it was");
    addLimits(*parser, options->limits);
    return {parser, [options](Console& console) {
                return options->file.empty() ? monitorNetwork(*options, console)
                                             : monitorFile(*options, console);
            }};
}

} // namespace posewire::cli
