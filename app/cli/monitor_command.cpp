// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_options.h"

#include "app/cli/command.h"

#include <array>

namespace posewire::cli {
namespace {

Option addPlace(Arguments arguments, const std::string& name, std::vector<std::string>& texts,
                const std::string& form, const std::string& what) {
    return arguments.add(name, texts, what + "; may be given several times")
        .form(form)
        .repeatable()
        .group("Where from");
}

void addPlaces(Arguments arguments, MonitorOptions& options) {
    const std::array<Option, 4> places{
        addPlace(arguments, "--udp", options.udp, "[ADDRESS:]PORT", "listen there (default 9763)"),
        addPlace(arguments, "--multicast", options.multicast, "GROUP", "join it at the UDP ports"),
        addPlace(arguments, "--tcp-listen", options.tcpListen, "[ADDRESS:]PORT",
                 "wait there for MVN to connect"),
        addPlace(arguments, "--tcp", options.tcp, "HOST:PORT", "connect there, again and again")};
    Option file = arguments.add("FILE", options.file,
                                "a recording instead of the network, as fast as it goes, with its own "
                                "stamps: pcap, pcapng, or datagrams back to back; - for standard input");
    for (const Option place : places) {
        file.excludes(place);
    }
}

void addLimits(Arguments arguments, Limits& limits) {
    for (std::size_t i = 0; i < kLimits.size(); ++i) {
        arguments.add("--max-" + std::string(kLimits[i].name), limits.most[i], std::string(kLimits[i].help))
            .form(unitOf(kLimits[i]) == " %" ? "PERCENT" : "MS")
            .notNegative()
            .group("Limits (of each stream; where one is exceeded the exit status is 1)");
    }
}

} // namespace

Command addMonitorCommand(CommandLine& program) {
    auto options = std::make_shared<MonitorOptions>();
    Arguments arguments = program.addCommand(
        "monitor", "Watch streams: rate, loss, duplicates, order, jitter, gaps; record them; keep limits");
    addPlaces(arguments, *options);
    arguments
        .add("--duration", options->durationSeconds,
             "stop after this many seconds; 0: when interrupted, or at the end of FILE")
        .form("SECONDS")
        .notNegative()
        .showDefault();
    arguments.flag("--json", options->asJson, "one report at the end instead of a live table");
    arguments.add("--interval", options->intervalSeconds, "seconds between two tables")
        .form("SECONDS")
        .positive()
        .showDefault();
    arguments.add("--record", options->record, "write everything received there as pcapng").form("FILE");
    arguments
        .add("--report", options->report,
             "write a report there as HTML: what was received, what not, and whose fault it was")
        .form("FILE");
    addLimits(arguments, options->limits);
    return {"monitor", [options](Console& console) {
                return options->file.empty() ? monitorNetwork(*options, console)
                                             : monitorFile(*options, console);
            }};
}

} // namespace posewire::cli
