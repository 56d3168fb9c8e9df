// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace posewire::log {

/// An IPv4 address in the first four bytes, or an IPv6 address.
struct IpAddress {
    std::array<std::byte, 16> bytes{};
    bool isIpv6 = false;
    friend auto operator<=>(const IpAddress&, const IpAddress&) = default;
};

struct IpEndpoint {
    IpAddress address;
    std::uint16_t port = 0;
    friend bool operator==(const IpEndpoint&, const IpEndpoint&) = default;
};

/// "10.0.0.2:40001", "[fe80::1]:40001" (RFC 5952).
[[nodiscard]] std::string endpointText(const IpEndpoint& endpoint);

/// The inverse. A zone of an IPv6 address ("%eth0") is passed over; names are not known.
[[nodiscard]] std::optional<IpEndpoint> parseIpEndpoint(std::string_view text);

/// 127.0.0.0/8 or ::1.
[[nodiscard]] bool isLoopback(const IpAddress& address);

/// The host of an address with a port, "10.0.0.2:40001" or "[fe80::1]:40001"; all of what has no port.
[[nodiscard]] constexpr std::string_view hostOf(std::string_view address) {
    return address.substr(0, address.rfind(':'));
}

} // namespace posewire::log
