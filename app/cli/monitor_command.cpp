// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_options.h"

#include <array>
#include <memory>

namespace posewire::cli {
namespace {

using Complaint = std::string;

tl::expected<std::vector<net::Endpoint>, Complaint> endpointsOf(const std::vector<std::string>& texts,
                                                                const std::string& option) {
    std::vector<net::Endpoint> endpoints;
    for (const std::string& text : texts) {
        auto endpoint = net::parseEndpoint(text);
        if (!endpoint) {
            return tl::unexpected(option + ": " + endpoint.error().text);
        }
        endpoints.push_back(std::move(*endpoint));
    }
    return endpoints;
}

/// Groups are joined on every port that is heard on all addresses.
void joinGroups(std::vector<net::UdpInput>& inputs, const std::vector<std::string>& groups) {
    bool isJoined = groups.empty();
    for (net::UdpInput& input : inputs) {
        if (input.endpoint.host.empty()) {
            input.groups = groups;
            isJoined = true;
        }
    }
    if (!isJoined) {
        inputs.push_back({net::Endpoint{}, groups});
    }
}

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

tl::expected<MonitorPlaces, Complaint> placesOf(const MonitorOptions& options) {
    const auto udp = endpointsOf(options.udp, "--udp");
    const auto tcpListen = endpointsOf(options.tcpListen, "--tcp-listen");
    const auto tcp = endpointsOf(options.tcp, "--tcp");
    for (const auto* list : {&udp, &tcpListen, &tcp}) {
        if (!*list) {
            return tl::unexpected(list->error());
        }
    }
    MonitorPlaces places{{}, *tcpListen, *tcp};
    for (const net::Endpoint& endpoint : *udp) {
        places.udp.push_back({endpoint, {}});
    }
    for (const net::Endpoint& endpoint : places.tcp) {
        if (endpoint.host.empty()) {
            return tl::unexpected("--tcp: " + std::to_string(endpoint.port) +
                                  " has no host; write HOST:PORT, or --tcp-listen to wait for the sender");
        }
    }
    if (udp->empty() && tcpListen->empty() && tcp->empty() && options.multicast.empty()) {
        places.udp.emplace_back();
    }
    joinGroups(places.udp, options.multicast);
    return places;
}

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
                    return console.unusable("--from must be before --to");
                }
                return monitorFile(*options, console);
            }};
}

} // namespace posewire::cli
