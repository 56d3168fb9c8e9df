// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/ip_packet.h"

#include <string_view>

namespace posewire::log {

struct IpEndpoint {
    IpAddress address;
    std::uint16_t port = 0;
    friend bool operator==(const IpEndpoint&, const IpEndpoint&) = default;
};

/// "10.0.0.2:40001", "[fe80::1]:40001".
[[nodiscard]] std::string endpointText(const IpEndpoint& endpoint);

/// The inverse. A zone of an IPv6 address ("%eth0") is passed over; names are not known.
[[nodiscard]] std::optional<IpEndpoint> parseIpEndpoint(std::string_view text);

/// 127.0.0.0/8 or ::1.
[[nodiscard]] bool isLoopback(const IpAddress& address);

} // namespace posewire::log
