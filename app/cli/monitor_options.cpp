// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_options.h"

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

} // namespace posewire::cli
