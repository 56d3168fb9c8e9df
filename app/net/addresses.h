// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/net_error.h"

#include <string>
#include <vector>

class QHostAddress;

namespace posewire::net {

/// The address of a host, IPv4 if it has both; this computer's if the host is empty. Blocks while a name is
/// resolved.
[[nodiscard]] NetResult<QHostAddress> lookUp(const Endpoint& endpoint);

/// "10.0.0.5:50123", as the operator writes it: IPv4 in its own form even where an IPv6 socket received it.
[[nodiscard]] std::string textOf(const QHostAddress& address, std::uint16_t port);

/// An address that this computer has.
struct LocalAddress {
    std::string address;   ///< "192.168.1.20", "fe80::1%eth0"
    std::string interface; ///< as the system calls it: "eth0", "Ethernet 2"
    bool isIpv4 = true;
    bool isLoopback = false;
    bool isLinkLocal = false; ///< valid only on its own network segment

    friend bool operator==(const LocalAddress&, const LocalAddress&) = default;
};

/// All addresses of interfaces that are up, as the system orders them.
[[nodiscard]] std::vector<LocalAddress> localAddresses();

/// The addresses to type into a sender, best first: IPv4 before IPv6, link-local last; loopback only if there
/// is nothing else.
[[nodiscard]] std::vector<LocalAddress> reachable(std::vector<LocalAddress> addresses);

} // namespace posewire::net
