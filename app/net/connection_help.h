// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/input.h"
#include "core/log/time.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace posewire::net {

/// A packet filter on this computer. Its rules are not read, which would need administrator rights.
struct Firewall {
    std::string name;   ///< "ufw", "firewalld", "nftables", "iptables"
    std::string remedy; ///< the command that opens a port; PORT/udp in it becomes the port
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

struct Finding {
    enum class Kind : std::uint8_t {
        NoInput,
        CannotOpen,
        AddressGone,   ///< the one that an input listens on
        NotJoined,     ///< a multicast group, on some interface or all
        NotListenedTo, ///< datagrams arrive, from hosts that are not listened to
        NotMxtp,
        NotReachable, ///< a TCP connection that keeps failing
        SilentPeer,   ///< connected by TCP but silent
        GarbledPeer,  ///< connected by TCP, but what it sends is not MXTP
        NothingArrives,
        OtherTransport, ///< only UDP or only TCP inputs are open, and the sender may use the other
        FirewallOn,
        WentSilent, ///< datagrams arrived once but no longer do
    };
    Kind kind{};
    std::string text;   ///< what is known, one sentence
    std::string remedy; ///< what to do, in MVN's own words where it concerns MVN

    friend bool operator==(const Finding&, const Finding&) = default;
};

/// Advice for an operator who sees nothing, most certain first; empty if all is well. Silence counts after
/// two seconds.
[[nodiscard]] std::vector<Finding> connectionHelp(const ConnectionFacts& facts);

/// What the first bytes of a foreign datagram look like, in words an operator knows: "OSC",
/// "NatNet (OptiTrack Motive)". Empty if they resemble nothing known. Only a guess: these protocols begin
/// with few fixed bytes.
[[nodiscard]] std::string protocolThatBegins(std::span<const std::byte> bytes);

} // namespace posewire::net
