// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The headers of IP, UDP and TCP, as captures have them.
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

/// A captured frame and its place in the file.
struct CapturedFrame {
    std::uint32_t linkType = 0; ///< a LINKTYPE_ value of the capture formats
    std::span<const std::byte> bytes;
    std::uint64_t offset = 0;
    std::optional<WallTime> time{};
};

/// What a captured frame carries over IP, or several frames with the fragments of one packet.
struct IpPacket {
    IpAddress sender;
    IpAddress target;
    std::uint8_t protocol = 0;        ///< kUdp, kTcp or another
    std::uint64_t offset = 0;         ///< of the payload in the file
    std::span<const std::byte> bytes; ///< the payload, as much as was captured
    std::optional<WallTime> time{};   ///< of the frame that completed it

    std::uint32_t identity = 0;       ///< common to the fragments of a packet
    std::uint32_t fragmentOffset = 0; ///< of this payload in the whole packet's, in bytes
    bool hasMoreFragments = false;
    bool isInOnePiece = true; ///< the payload in the file

    [[nodiscard]] bool isFragment() const { return hasMoreFragments || fragmentOffset != 0; }
};

inline constexpr std::uint8_t kTcp = 6;
inline constexpr std::uint8_t kUdp = 17;

/// True if ipPacketOf() looks through frames of that LINKTYPE_ value.
[[nodiscard]] bool isLinkTypeKnown(std::uint32_t linkType);

/// Looks through the headers of a captured frame: Ethernet (with VLAN tags), Linux cooked (SLL and SLL2), raw
/// IP and BSD loopback, then IPv4 or IPv6. Empty for anything else.
[[nodiscard]] std::optional<IpPacket> ipPacketOf(const CapturedFrame& frame);

struct UdpPayload {
    std::uint64_t offset = 0;         ///< in the file
    std::span<const std::byte> bytes; ///< as much as was captured
    std::uint16_t sourcePort = 0;
    std::uint16_t targetPort = 0;
};

/// Empty if the packet is not UDP.
[[nodiscard]] std::optional<UdpPayload> udpPayloadOf(const IpPacket& packet);

/// A segment of TCP (RFC 9293 section 3.1).
struct TcpSegment {
    std::uint16_t sourcePort = 0;
    std::uint16_t targetPort = 0;
    std::uint32_t sequence = 0;       ///< of the first byte of `bytes`
    std::span<const std::byte> bytes; ///< as much as was captured
    std::uint64_t offset = 0;         ///< of `bytes` in the file
    std::optional<WallTime> time{};
    bool begins = false;      ///< SYN
    bool ends = false;        ///< FIN or RST
    bool isInOnePiece = true; ///< in the file
};

/// Empty if the header of the segment is damaged. The packet must be TCP.
[[nodiscard]] std::optional<TcpSegment> tcpSegmentOf(const IpPacket& packet);

/// Appends an IP packet that carries `payload` over UDP, with right lengths and checksums (RFC 791, 768,
/// 8200). What is too long for IPv4 goes with mapped addresses (RFC 4291 section 2.5.5.2) over IPv6; what is
/// too long for that as well is a jumbogram (RFC 2675). Both addresses must be of the same version.
void appendUdpFrame(std::vector<std::byte>& out, const IpEndpoint& sender, const IpEndpoint& target,
                    std::span<const std::byte> payload);

} // namespace posewire::log
