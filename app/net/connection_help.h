// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/input.h"
#include "core/log/time.h"
#include "core/words/fact.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace posewire::net {

/// A packet filter on this computer. Its rules are not read, which would need administrator rights.
struct Firewall {
    std::string name;    ///< "ufw", "firewalld", "nftables", "iptables"
    std::string command; ///< opens a port; PORT/udp in it becomes the port; empty if there is none
};

/// The active packet filter, as far as files that any user may read show it; `root` is for tests. Empty
/// if none was found, which is no proof that there is none.
[[nodiscard]] std::optional<Firewall> findFirewall(const std::string& root = "/");

struct FailedInput {
    InputKind kind = InputKind::Udp;
    Endpoint endpoint;
    NetError error;
};

/// Everything that can explain why no characters are visible.
struct ConnectionFacts {
    std::vector<InputStatus> inputs;
    std::vector<FailedInput> failed;
    std::uint64_t mxtpDatagrams = 0;     ///< received in total, malformed ones included
    log::Duration silence{};             ///< since the newest of them, or since the inputs were opened
    std::vector<words::Fact> foreign;    ///< see model::Sender::foreignFact()
    std::vector<LocalAddress> addresses; ///< see reachable()
    std::optional<Firewall> firewall;
    log::Stamp now{};
};

/// Advice for an operator who sees nothing, most certain first; empty if all is well. Silence counts after
/// two seconds.
[[nodiscard]] std::vector<words::Fact> connectionHelp(const ConnectionFacts& facts);

} // namespace posewire::net
