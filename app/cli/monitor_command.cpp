// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor.h"

#include <array>
#include <memory>

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
        addPlace(arguments, "--udp", options.udp, "[ADDRESS:]PORT",
                 "listen there (default 9763); ADDRESS is one of this computer's, where it has several "
                 "networks and only one is meant: broadcasts and multicast may then not arrive"),
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
    file.excludes(addPlace(arguments, "--from", options.allowed, "HOST|NET",
                           "listen only to this address, net (such as 192.168.1.0/24) or host; others are "
                           "not recorded, only counted"));
}

void addLimits(Arguments arguments, Limits& limits) {
    for (std::size_t i = 0; i < kLimits.size(); ++i) {
        const bool isShare = unitOf(kLimits[i]) == " %";
        const Option limit =
            arguments.add("--max-" + std::string(kLimits[i].name), limits[i], std::string(kLimits[i].help));
        (isShare ? Option(limit).within(0.0, 100.0) : Option(limit).milliseconds())
            .form(isShare ? "PERCENT" : "MS")
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
        .seconds()
        .showDefault();
    Option lines = arguments.flag("--json-lines", options->asJsonLines,
                                  "an object a line instead of a live table, each interval and when the "
                                  "verdict changes: verdict, characters, incidents that changed");
    lines.excludes(
        arguments.flag("--json", options->asJson, "one report at the end instead of a live table"));
    arguments.add("--interval", options->intervalSeconds, "seconds between two tables or lines")
        .form("SECONDS")
        .within(0.001, 86'400.0)
        .showDefault();
    arguments
        .add("--record", options->record,
             "write everything received there as pcapng; - for standard output, instead of the table")
        .form("FILE");
    arguments
        .add("--report", options->report,
             "write a report there as HTML: what was received, what not, and whose fault it was")
        .form("FILE");
    arguments.force(options->replaces);
    arguments.verbose(
        options->isVerbose,
        "where it listens, of each sender when it is first heard, and in the JSON what is kept in memory");
    addLimits(arguments, options->limits);
    return {"monitor", [options](Console& console) {
                options->isQuiet = options->record == "-";
                return options->file.empty() ? monitorNetwork(*options, console)
                                             : monitorFile(*options, console);
            }};
}

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
    arguments.force(options->replaces);
    arguments.add("--from", options->fromSeconds, "begin this many seconds after the first datagram")
        .form("SECONDS")
        .seconds();
    arguments.add("--to", options->toSeconds, "end this many seconds after the first datagram")
        .form("SECONDS")
        .seconds();
    return {"report", [options](Console& console) {
                if (options->fromSeconds && options->toSeconds &&
                    *options->fromSeconds >= *options->toSeconds) {
                    return console.unusable("--from must be before --to");
                }
                return monitorFile(*options, console);
            }};
}

} // namespace posewire::cli
