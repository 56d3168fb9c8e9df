// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor.h"

#include <array>
#include <memory>

namespace posewire::cli {
namespace {

DeclaredOption addPlace(Arguments arguments, const std::string& name, std::vector<std::string>& texts,
                        const std::string& what) {
    return arguments.add(name, texts, what + "; may be given several times").group("Where from");
}

void addPlaces(Arguments arguments, MonitorOptions& options) {
    const std::array<DeclaredOption, 4> places{
        addPlace(arguments, "--udp [ADDRESS:]PORT", options.udp,
                 "listen there (default 9763); ADDRESS is one of this computer's, where it has several "
                 "networks and only one is meant: broadcasts and multicast may then not arrive"),
        addPlace(arguments, "--multicast GROUP", options.multicast, "join it at the UDP ports"),
        addPlace(arguments, "--tcp-listen [ADDRESS:]PORT", options.tcpListen,
                 "wait there for MVN to connect"),
        addPlace(arguments, "--tcp HOST:PORT", options.tcp, "connect there, again and again")};
    DeclaredOption file =
        arguments.add("FILE", options.file,
                      "a recording instead of the network, as fast as it goes, with its own "
                      "stamps: pcap, pcapng, or datagrams back to back; - for standard input");
    for (const DeclaredOption place : places) {
        file.excludes(place);
    }
    file.excludes(addPlace(arguments, "--from HOST|NET", options.allowed,
                           "listen only to this address, net (such as 192.168.1.0/24) or host; others are "
                           "not recorded, only counted"));
}

void addLimits(Arguments arguments, Limits& limits) {
    for (std::size_t i = 0; i < kLimits.size(); ++i) {
        const bool isShare = unitOf(kLimits[i]) == " %";
        const DeclaredOption limit =
            arguments.add("--max-" + std::string(kLimits[i].name) + (isShare ? " PERCENT" : " MS"), limits[i],
                          std::string(kLimits[i].help));
        (isShare ? DeclaredOption(limit).within(0.0, 100.0) : DeclaredOption(limit).milliseconds())
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
        .add("--duration SECONDS", options->durationSeconds,
             "stop after this many seconds; 0: when interrupted, or at the end of FILE")
        .seconds()
        .showDefault();
    DeclaredOption lines =
        arguments.flag("--json-lines", options->asJsonLines,
                       "an object a line instead of a live table, each interval and when the "
                       "verdict changes: verdict, characters, incidents that changed");
    lines.excludes(
        arguments.flag("--json", options->asJson, "one report at the end instead of a live table"));
    arguments.add("--interval SECONDS", options->intervalSeconds, "seconds between two tables or lines")
        .within(0.001, 86'400.0)
        .showDefault();
    arguments.add("--record FILE", options->record,
                  "write everything received there as pcapng; - for standard output, instead of the table");
    arguments.add("--report FILE", options->report,
                  "write a report there as HTML: what was received, what not, and whose fault it was");
    arguments.force(options->replaces);
    arguments.verbose(options->isVerbose,
                      "where it listens and each new sender; the JSON then has what is kept in memory, too");
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
    arguments.add("-o,--output FILE", options->report, "the HTML file; - for standard output").required();
    arguments.force(options->replaces);
    arguments.add("--from SECONDS", options->fromSeconds, "begin this many seconds after the first datagram")
        .seconds();
    arguments.add("--to SECONDS", options->toSeconds, "end this many seconds after the first datagram")
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
