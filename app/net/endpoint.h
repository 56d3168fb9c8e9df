// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/net_error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace posewire::net {

/// The port that MVN sends to by default.
inline constexpr std::uint16_t kDefaultPort = 9763;

struct Endpoint {
    std::string host; ///< name or address; empty means every address of this computer
    std::uint16_t port = kDefaultPort;

    friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// "127.0.0.1:9763", "[::1]:9763"; ":9763" where there is no host.
[[nodiscard]] std::string textOf(const Endpoint& endpoint);

/// "PORT", "HOST:PORT", "[IPv6]:PORT". Port 0 is accepted: the system then picks a free one.
[[nodiscard]] NetResult<Endpoint> parseEndpoint(std::string_view text);

} // namespace posewire::net
