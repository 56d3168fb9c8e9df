// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/ip_packet.h"

namespace posewire::log {

/// What an IP packet carries over UDP.
struct UdpPayload {
    std::size_t offset = 0;           ///< of the payload in the segment
    std::span<const std::byte> bytes; ///< as much as was captured
    std::uint16_t sourcePort = 0;
    std::uint16_t targetPort = 0;
};

/// `segment` is the payload of the packet, or what its fragments were put together to. Empty where that is
/// not UDP.
[[nodiscard]] std::optional<UdpPayload> udpPayloadOf(const IpPacket& packet,
                                                     std::span<const std::byte> segment);

} // namespace posewire::log
