// SPDX-License-Identifier: MIT
#include "core/log/udp_payload.h"

#include "core/wire/byte_order.h"

#include <algorithm>

namespace posewire::log {

std::optional<UdpPayload> udpPayloadOf(const IpPacket& packet, std::span<const std::byte> segment) {
    constexpr std::size_t headerSize = 8;
    if (packet.protocol != kUdp || segment.size() < headerSize) {
        return std::nullopt;
    }
    // A size of 0 is what a card leaves there that cuts the packet itself, as in the header of IP.
    const std::size_t announced = wire::load16(segment.data() + 4);
    const std::size_t size = announced >= headerSize ? std::min(announced, segment.size()) : segment.size();
    return UdpPayload{headerSize, segment.subspan(headerSize, size - headerSize),
                      wire::load16(segment.data()), wire::load16(segment.data() + 2)};
}

} // namespace posewire::log
