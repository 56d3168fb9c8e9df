// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"

#include <cstdint>
#include <optional>
#include <span>

namespace posewire::log {

/// What a captured frame carries over UDP.
struct UdpPayload {
    std::size_t offset = 0;           ///< of the payload in the frame
    std::span<const std::byte> bytes; ///< as much as was captured
    SourceInfo source;
    bool isLaterFragment = false; ///< continues a datagram; address and ports are not known
};

/// Looks through the headers of a captured frame: Ethernet (with VLAN tags), Linux cooked (SLL and SLL2), raw
/// IP and BSD loopback, then IPv4 or IPv6, then UDP. Empty for anything else. `linkType` is a LINKTYPE_ value
/// of the capture formats. Fragments are not put together: the first gives what it has.
[[nodiscard]] std::optional<UdpPayload> udpPayloadOf(std::uint32_t linkType,
                                                     std::span<const std::byte> frame);

} // namespace posewire::log
