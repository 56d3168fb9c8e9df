// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/firewall.h"
#include "app/net/input.h"
#include "app/net/local_addresses.h"
#include "app/net/net_error.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace posewire::net {

/// Datagrams of one sender that are not MXTP.
struct ForeignSender {
    std::string address;
    std::uint64_t count = 0;
    std::vector<std::byte> firstBytes; ///< of the newest, as many as are kept
};

/// An input that could not be opened.
struct FailedInput {
    InputKind kind = InputKind::Udp;
    Endpoint endpoint;
    NetError error;
};

/// Everything that tells why no characters are seen.
struct ConnectionFacts {
    std::vector<InputStatus> inputs;
    std::vector<FailedInput> failed;
    std::uint64_t mxtpDatagrams = 0; ///< ever received, also malformed ones
    std::int64_t silenceNs = 0;      ///< since the newest of them, else since the inputs were opened
    std::vector<ForeignSender> foreign;
    std::vector<LocalAddress> addresses; ///< see reachable()
    std::optional<Firewall> firewall;
    std::int64_t nowNs = 0; ///< since 1970-01-01 UTC
};

/// One thing that is, or may be, wrong.
struct Finding {
    enum class Kind : std::uint8_t {
        NoInput,
        CannotOpen,
        NotMxtp,
        NotReachable, ///< a TCP connection that is tried again and again
        SilentPeer,   ///< connected by TCP, and nothing comes
        GarbledPeer,  ///< connected by TCP, and what comes is not MXTP
        NothingArrives,
        OtherTransport, ///< only one of UDP and TCP is listened to, and the sender may use the other
        FirewallOn,
        WentSilent, ///< datagrams came, and come no more
    };
    Kind kind{};
    std::string text;   ///< what is known, one sentence
    std::string remedy; ///< what to do, in the words of MVN where it is about MVN

    friend bool operator==(const Finding&, const Finding&) = default;
};

/// What to tell an operator who sees nothing, the surest first; empty where all is well. Silence counts from
/// two seconds on.
[[nodiscard]] std::vector<Finding> connectionHelp(const ConnectionFacts& facts);

} // namespace posewire::net
