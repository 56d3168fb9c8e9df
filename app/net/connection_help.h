// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/input.h"
#include "core/log/time.h"
#include "core/words/fact.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
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

struct ForeignSender {
    std::string address;
    std::uint64_t count = 0;
    std::vector<std::byte> firstBytes; ///< of the newest datagram, as far as they are kept
};

struct FailedInput {
    InputKind kind = InputKind::Udp;
    Endpoint endpoint;
    NetError error;
};

/// Everything that can explain why no characters are visible.
struct ConnectionFacts {
    std::vector<InputStatus> inputs;
    std::vector<FailedInput> failed;
    std::uint64_t mxtpDatagrams = 0; ///< received in total, malformed ones included
    log::Duration silence{};         ///< since the newest of them, or since the inputs were opened
    std::vector<ForeignSender> foreign;
    std::vector<LocalAddress> addresses; ///< see reachable()
    std::optional<Firewall> firewall;
    log::Stamp now{};
};

/// Advice for an operator who sees nothing, most certain first; empty if all is well. Silence counts after
/// two seconds.
[[nodiscard]] std::vector<words::Fact> connectionHelp(const ConnectionFacts& facts);

/// The protocol that the first bytes of a foreign datagram look like; nothing if they resemble none that is
/// known. Only a guess: these protocols begin with few fixed bytes.
[[nodiscard]] words::Fact protocolThatBegins(std::span<const std::byte> bytes);

} // namespace posewire::net
