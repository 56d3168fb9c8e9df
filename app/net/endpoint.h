// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tl/expected.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

class QHostAddress;
class QNetworkInterface;

namespace posewire::net {

struct NetError {
    enum class Kind : std::uint8_t {
        PortInUse,
        NoPermission,
        AddressNotHere,
        HostNotFound,
        NotConnected,
        BadEndpoint,
        Other
    };
    Kind kind = Kind::Other;
    std::string text; ///< what, where, what to do: one line for the operator
};

template <typename T>
using NetResult = tl::expected<T, NetError>;

inline tl::unexpected<NetError> netError(NetError::Kind kind, std::string text) {
    return tl::unexpected(NetError{kind, std::move(text)});
}

/// The port that MVN sends to by default.
inline constexpr std::uint16_t kDefaultPort = 9763;

struct Endpoint {
    std::string host; ///< name or address; empty means every address of this computer
    std::uint16_t port = kDefaultPort;

    friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// "127.0.0.1:9763", "[::1]:9763"; ":9763" if there is no host.
[[nodiscard]] std::string textOf(const Endpoint& endpoint);

/// "10.0.0.5:50123", as the operator writes it: IPv4 in its own form even where an IPv6 socket received it.
[[nodiscard]] std::string textOf(const QHostAddress& address, std::uint16_t port);

/// "PORT", "HOST:PORT", "[IPv6]:PORT". Port 0 is accepted: the system then picks a free one.
[[nodiscard]] NetResult<Endpoint> parseEndpoint(std::string_view text);

/// The same of somebody to send or connect to, who cannot have port 0.
[[nodiscard]] NetResult<Endpoint> parseTarget(std::string_view text);

/// The address of a host, IPv4 if it has both; this computer's if the host is empty. Blocks while a name is
/// resolved.
[[nodiscard]] NetResult<QHostAddress> lookUp(const Endpoint& endpoint);

/// The interface that an IPv6 address names after its %, by name or index; an invalid one where it names none
/// or there is none of that name now.
[[nodiscard]] QNetworkInterface zoneOf(const QHostAddress& address);

/// That an address names an interface that is not here, with what to do, in one line; empty if it names
/// none or one that is.
[[nodiscard]] std::string problemWithZone(const QHostAddress& address);

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
