// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace posewire::net {

/// A packet filter on this computer. Its rules are not read, which would need administrator rights.
struct Firewall {
    std::string name;   ///< "ufw", "firewalld", "nftables", "iptables"
    std::string remedy; ///< what opens a port, with "PORT/udp" as its placeholder
};

/// The active packet filter, as far as files that any user may read show it; `root` is for tests. Empty
/// if none was found, which is no proof that there is none.
[[nodiscard]] std::optional<Firewall> findFirewall(const std::string& root = "/");

} // namespace posewire::net
