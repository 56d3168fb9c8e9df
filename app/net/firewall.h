// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace posewire::net {

/// A packet filter of this computer. Its rules are not read: that would take an administrator.
struct Firewall {
    std::string name;   ///< "ufw", "firewalld", "nftables", "iptables"
    std::string remedy; ///< what lets a port through, with "PORT/udp" where the port belongs
};

/// The packet filter that is switched on, as far as this system's files tell without special rights; `root`
/// is for tests. Nothing where none is seen, which does not mean that there is none.
[[nodiscard]] std::optional<Firewall> findFirewall(const std::string& root = "/");

} // namespace posewire::net
