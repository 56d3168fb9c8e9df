// SPDX-License-Identifier: MIT
#include "core/log/ip_packet.h"

#include "core/wire/byte_order.h"

#include <algorithm>

namespace posewire::log {
namespace {

using Frame = std::span<const std::byte>;

constexpr std::uint16_t kIpv4 = 0x0800;
constexpr std::uint16_t kIpv6 = 0x86dd;

std::uint8_t byteAt(Frame frame, std::size_t place) {
    return std::to_integer<std::uint8_t>(frame[place]);
}
std::uint16_t wordAt(Frame frame, std::size_t place) {
    return wire::load16(frame.data() + place);
}

/// Where the network layer begins.
struct Network {
    std::size_t offset;
};

/// Follows the EtherType at `place`, over VLAN tags.
std::optional<Network> afterEtherType(Frame frame, std::size_t place) {
    while (frame.size() >= place + 2) {
        const std::uint16_t type = wordAt(frame, place);
        if (type == kIpv4 || type == kIpv6) {
            return Network{place + 2};
        }
        if (type != 0x8100 && type != 0x88a8) {
            return std::nullopt;
        }
        place += 4;
    }
    return std::nullopt;
}

/// LINKTYPE_ values as registered for pcap and pcapng.
std::optional<Network> networkOf(std::uint32_t linkType, Frame frame) {
    switch (linkType) {
    case 0:   // BSD loopback: an address family of four bytes; the version of IP says the rest
    case 108: // OpenBSD loopback
        return Network{4};
    case 1: // Ethernet
        return afterEtherType(frame, 12);
    case 12: // raw IP, by three numbers
    case 14:
    case 101:
    case 228: // IPv4
    case 229: // IPv6
        return Network{0};
    case 113: // Linux cooked
        return afterEtherType(frame, 14);
    case 276: // Linux cooked, version 2
        return frame.size() >= 20 && (wordAt(frame, 0) == kIpv4 || wordAt(frame, 0) == kIpv6)
                   ? std::optional(Network{20})
                   : std::nullopt;
    default:
        return std::nullopt;
    }
}

std::string ipv4Text(Frame address) {
    std::string text = std::to_string(byteAt(address, 0));
    for (std::size_t i = 1; i < 4; ++i) {
        text.append(1, '.').append(std::to_string(byteAt(address, i)));
    }
    return text;
}

/// RFC 5952: small letters, the longest run of two or more zero groups left out.
std::string bracedIpv6Text(Frame address) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::size_t longestStart = 8;
    std::size_t longest = 1;
    for (std::size_t i = 0; i < 8; ++i) {
        std::size_t end = i;
        while (end < 8 && wordAt(address, 2 * end) == 0) {
            ++end;
        }
        if (end - i > longest) {
            longest = end - i;
            longestStart = i;
        }
    }
    std::string text = "[";
    for (std::size_t i = 0; i < 8; ++i) {
        if (i == longestStart) {
            text += "::";
            i += longest - 1;
            continue;
        }
        text += text.size() == 1 || text.back() == ':' ? "" : ":";
        const unsigned group = wordAt(address, 2 * i);
        for (int shift = 12; shift >= 0; shift -= 4) {
            if (shift == 0 || group >> shift != 0) {
                text += digits[group >> shift & 15U];
            }
        }
    }
    return text + ']';
}

IpAddress addressAt(Frame packet, std::size_t place, bool isIpv6) {
    IpAddress address{{}, isIpv6};
    const Frame bytes = packet.subspan(place, isIpv6 ? 16 : 4);
    std::copy(bytes.begin(), bytes.end(), address.bytes.begin());
    return address;
}

std::optional<IpPacket> throughIpv4(Frame frame, std::size_t start) {
    const Frame packet = frame.subspan(start);
    if (packet.size() < 20) {
        return std::nullopt;
    }
    const std::size_t headerSize = (byteAt(packet, 0) & std::size_t{15}) * 4;
    const std::size_t totalSize = wordAt(packet, 2);
    if (headerSize < 20 || packet.size() < headerSize) {
        return std::nullopt;
    }
    // A total size of 0 is what a card leaves there that cuts the packet itself.
    const std::size_t size = totalSize >= headerSize ? std::min(totalSize, packet.size()) : packet.size();
    const unsigned flags = wordAt(packet, 6);
    return IpPacket{addressAt(packet, 12, false),
                    addressAt(packet, 16, false),
                    byteAt(packet, 9),
                    start + headerSize,
                    packet.subspan(headerSize, size - headerSize),
                    wordAt(packet, 4),
                    (flags & 0x1fffU) * 8,
                    (flags & 0x2000U) != 0};
}

std::optional<IpPacket> throughIpv6(Frame frame, std::size_t start) {
    const Frame packet = frame.subspan(start);
    if (packet.size() < 40) {
        return std::nullopt;
    }
    // A size of 0 belongs to a jumbogram (RFC 2675), or to a packet that a card will cut.
    const std::size_t announced = wordAt(packet, 4);
    const std::size_t size = announced != 0 ? std::min(40U + announced, packet.size()) : packet.size();
    IpPacket found;
    found.sender = addressAt(packet, 8, true);
    found.target = addressAt(packet, 24, true);
    found.protocol = byteAt(packet, 6);
    std::size_t place = 40;
    constexpr std::uint8_t fragment = 44;
    constexpr std::array<std::uint8_t, 4> extensions{0, 43, fragment, 60}; // the others: options, routing
    // What follows the header of a fragment is data of the whole packet.
    while (std::ranges::find(extensions, found.protocol) != extensions.end() && size >= place + 8 &&
           !found.isFragment()) {
        const bool isFragment = found.protocol == fragment;
        if (isFragment) {
            found.fragmentOffset = wordAt(packet, place + 2) & 0xfff8U;
            found.hasMoreFragments = (wordAt(packet, place + 2) & 1U) != 0;
            found.identity = wire::load32(packet.data() + place + 4);
        }
        found.protocol = byteAt(packet, place);
        place += isFragment ? 8U : 8U + 8U * byteAt(packet, place + 1);
    }
    if (place > size) {
        return std::nullopt;
    }
    found.offset = start + place;
    found.bytes = packet.subspan(place, size - place);
    return found;
}

} // namespace

std::string addressText(const IpAddress& address) {
    return address.isIpv6 ? bracedIpv6Text(address.bytes) : ipv4Text(address.bytes);
}

std::optional<IpPacket> ipPacketOf(std::uint32_t linkType, Frame frame) {
    const auto network = networkOf(linkType, frame);
    if (!network || frame.size() <= network->offset) {
        return std::nullopt;
    }
    switch (byteAt(frame, network->offset) >> 4) {
    case 4:
        return throughIpv4(frame, network->offset);
    case 6:
        return throughIpv6(frame, network->offset);
    default:
        return std::nullopt;
    }
}

} // namespace posewire::log
