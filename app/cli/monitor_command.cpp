// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_options.h"

#include <CLI/CLI.hpp>

#include <array>

namespace posewire::cli {
namespace {

CLI::Option* addPlace(CLI::App& parser, const std::string& name, std::vector<std::string>& texts,
                      const std::string& form, const std::string& what) {
    return parser.add_option(name, texts, what + "; may be given several times")
        ->type_name(form)
        ->expected(1)
        ->take_all()
        ->group("Where from");
}

void addPlaces(CLI::App& parser, MonitorOptions& options) {
    const std::array<CLI::Option*, 4> places{
        addPlace(parser, "--udp", options.udp, "[ADDRESS:]PORT", "listen there (default 9763)"),
        addPlace(parser, "--multicast", options.multicast, "GROUP", "join it at the UDP ports"),
        addPlace(parser, "--tcp-listen", options.tcpListen, "[ADDRESS:]PORT",
                 "wait there for MVN to connect"),
        addPlace(parser, "--tcp", options.tcp, "HOST:PORT", "connect there, again and again")};
    CLI::Option* file =
        parser.add_option("FILE", options.file,
                          "a recording instead of the network, as fast as it goes, with its own "
                          "stamps: pcap, pcapng, or datagrams back to back; - for standard input");
    for (CLI::Option* place : places) {
        file->excludes(place);
    }
}

void addLimits(CLI::App& parser, Limits& limits) {
    const auto add = [&](const std::string& name, std::optional<double>& limit, const std::string& what) {
        parser.add_option(name, limit, what)
            ->type_name(name == "--max-loss" ? "PERCENT" : "MS")
            ->check(CLI::NonNegativeNumber)
            ->group("Limits (of each stream; where one is exceeded the exit status is 1)");
    };
    add("--max-loss", limits.lossPercent, "samples lost or incomplete");
    add("--max-jitter", limits.jitterMs, "jitter as in RFC 3550");
    add("--max-gap", limits.gapMs, "time between successive samples");
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
        ->type_name("SECONDS")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    parser->add_flag("--json", options->asJson, "one report at the end instead of a live table");
    parser->add_option("--interval", options->intervalSeconds, "seconds between two tables")
        ->type_name("SECONDS")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    parser->add_option("--record", options->record, "write everything received there as pcapng")
        ->type_name("FILE");
    parser
        ->add_option("--report", options->report,
                     "write a report there as HTML: what was received, what not, and whose fault it was")
        ->type_name("FILE");
    addLimits(*parser, options->limits);
    return {parser, [options](Console& console) {
                return options->file.empty() ? monitorNetwork(*options, console)
                                             : monitorFile(*options, console);
            }};
}

} // namespace posewire::cli
