// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace posewire::log {

/// An IPv4 address in the first four bytes, or an IPv6 address.
struct IpAddress {
    std::array<std::byte, 16> bytes{};
    bool isIpv6 = false;
    friend auto operator<=>(const IpAddress&, const IpAddress&) = default;
};

/// "10.0.0.2", or "[fe80::1]" (RFC 5952).
[[nodiscard]] std::string addressText(const IpAddress& address);

/// What a captured frame carries over IP.
struct IpPacket {
    IpAddress sender;
    IpAddress target;
    std::uint8_t protocol = 0;        ///< kUdp, kTcp or another
    std::size_t offset = 0;           ///< of the payload in the frame
    std::span<const std::byte> bytes; ///< the payload, as much as was captured

    std::uint32_t identity = 0;       ///< common to the fragments of a packet
    std::uint32_t fragmentOffset = 0; ///< of this payload in the whole packet's, in bytes
    bool hasMoreFragments = false;

    [[nodiscard]] bool isFragment() const { return hasMoreFragments || fragmentOffset != 0; }
};

inline constexpr std::uint8_t kTcp = 6;
inline constexpr std::uint8_t kUdp = 17;

/// Looks through the headers of a captured frame: Ethernet (with VLAN tags), Linux cooked (SLL and SLL2), raw
/// IP and BSD loopback, then IPv4 or IPv6. Empty for anything else. `linkType` is a LINKTYPE_ value of the
/// capture formats.
[[nodiscard]] std::optional<IpPacket> ipPacketOf(std::uint32_t linkType, std::span<const std::byte> frame);

} // namespace posewire::log
