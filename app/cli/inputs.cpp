// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/inputs.h"

#include <QHostAddress>

#include <algorithm>
#include <iterator>
#include <utility>

namespace posewire::cli {
namespace {

tl::expected<std::vector<net::Endpoint>, std::string> endpointsOf(const std::vector<std::string>& texts,
                                                                  const std::string& option,
                                                                  decltype(net::parseEndpoint)& parse) {
    std::vector<net::Endpoint> endpoints;
    for (const std::string& text : texts) {
        auto endpoint = parse(text);
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

/// True if the usual port is heard on one address only, so that it receives no multicast.
bool isAlone(const std::vector<net::UdpInput>& inputs, const net::UdpInput& input) {
    const QHostAddress address(QString::fromStdString(input.endpoint.host));
    const bool isUsual = input.endpoint.port == net::Endpoint{}.port;
    return isUsual && !address.isNull() && !address.isMulticast() &&
           std::ranges::none_of(inputs, [](const auto& one) { return one.endpoint.host.empty(); });
}

net::NetResult<void> open(net::Receiver& receiver, const Places& places) {
    for (const net::UdpInput& input : places.udp) {
        if (const auto added = receiver.addUdp(input); !added) {
            return tl::unexpected(added.error());
        }
    }
    for (const net::Endpoint& endpoint : places.tcpListen) {
        if (const auto added = receiver.addTcpListener(endpoint); !added) {
            return tl::unexpected(added.error());
        }
    }
    for (const net::Endpoint& endpoint : places.tcp) {
        receiver.addTcpConnection(endpoint);
    }
    return {};
}

/// Names the port that the system chose, where port 0 asked for any that is free.
void tellChosenPorts(const net::Receiver& receiver, const Places& places, Console& console) {
    std::vector<net::Endpoint> asked;
    std::ranges::transform(places.udp, std::back_inserter(asked), &net::UdpInput::endpoint);
    asked.insert(asked.end(), places.tcpListen.begin(), places.tcpListen.end());
    const std::vector<net::InputStatus> inputs = receiver.inputs(); // in the same order
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if (asked[i].port == 0) {
            console.complain("port 0 means any that is free: listening on " +
                             net::textOf(inputs[i].endpoint) +
                             (inputs[i].kind == net::InputKind::Udp ? " (UDP)" : " (TCP)"));
        }
    }
}

void tellInputs(const net::Receiver& receiver, Console& console) {
    for (const net::InputStatus& input : receiver.inputs()) {
        const bool isConnection = input.kind == net::InputKind::TcpConnection;
        console.complain((isConnection ? "connecting to " : "listening on ") + placeOf(input) +
                         (input.kind == net::InputKind::Udp ? " (UDP)" : " (TCP)"));
    }
}

DeclaredOption addPlace(Arguments arguments, const std::string& name, std::vector<std::string>& texts,
                        const std::string& what) {
    return arguments.add(name, texts, what + "; may be given several times").group("Where from");
}

} // namespace

std::string placeOf(const net::InputStatus& input) {
    return input.endpoint.host.empty() ? "port " + std::to_string(input.endpoint.port)
                                       : net::textOf(input.endpoint);
}

tl::expected<Places, std::string> placesOf(const InputOptions& options) {
    const auto udp = endpointsOf(options.udp, "--udp", net::parseEndpoint);
    const auto tcpListen = endpointsOf(options.tcpListen, "--tcp-listen", net::parseEndpoint);
    const auto tcp = endpointsOf(options.tcp, "--tcp", net::parseTarget);
    for (const auto* list : {&udp, &tcpListen, &tcp}) {
        if (!*list) {
            return tl::unexpected(list->error());
        }
    }
    Places places{{}, *tcpListen, *tcp};
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
    for (const net::UdpInput& input : places.udp) {
        if (!options.multicast.empty() && isAlone(places.udp, input)) {
            return tl::unexpected("--multicast: port " + std::to_string(input.endpoint.port) + " of " +
                                  input.endpoint.host + " alone receives no multicast; write --udp " +
                                  std::to_string(input.endpoint.port));
        }
    }
    joinGroups(places.udp, options.multicast);
    return places;
}

std::array<DeclaredOption, 5> addPlaces(Arguments arguments, InputOptions& options) {
    return {addPlace(arguments, "--udp [ADDRESS:]PORT", options.udp,
                     "listen there (default 9763); ADDRESS is one of this computer's, where it has several "
                     "networks and only one is meant: broadcasts and multicast may then not arrive"),
            addPlace(arguments, "--multicast GROUP", options.multicast, "join it at the UDP ports"),
            addPlace(arguments, "--tcp-listen [ADDRESS:]PORT", options.tcpListen,
                     "wait there for MVN to connect"),
            addPlace(arguments, "--tcp HOST:PORT", options.tcp, "connect there, again and again"),
            addPlace(arguments, "--sender HOST|NET", options.allowed,
                     "listen only to this address, net (such as 192.168.1.0/24) or host; others are not "
                     "recorded, only counted")
                .formerly("--from")};
}

void addDuration(Arguments arguments, double& seconds) {
    arguments.add("--duration SECONDS", seconds, "stop after this many seconds; 0: never")
        .seconds()
        .showDefault();
}

bool openInputs(const Places& places, const InputOptions& options, bool isVerbose, net::Receiver& receiver,
                Console& console) {
    const auto allowed = net::AllowList::of(options.allowed);
    if (!allowed) {
        console.complain("--sender: " + allowed.error().text);
        return false;
    }
    receiver.listenTo(*allowed); // before the first port is open
    if (const auto opened = open(receiver, places); !opened) {
        console.complain(opened.error().text);
        return false;
    }
    tellChosenPorts(receiver, places, console);
    if (isVerbose) {
        tellInputs(receiver, console);
    }
    return true;
}

} // namespace posewire::cli
