// SPDX-License-Identifier: MIT
#include "core/log/ip_packet.h"

#include "core/wire/byte_order.h"

#include <algorithm>
#include <charconv>

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

/// Where the network layer begins, of a frame of the EtherType at `place` with its content at `content`:
/// behind VLAN tags.
std::optional<std::size_t> afterEtherType(Frame frame, std::size_t place, std::size_t content) {
    while (frame.size() >= content) {
        const std::uint16_t type = wordAt(frame, place);
        if (type == kIpv4 || type == kIpv6) {
            return content;
        }
        if (type != 0x8100 && type != 0x88a8 && type != 0x9100) { // the last one before it was standardised
            return std::nullopt;
        }
        place = content + 2;
        content += 4;
    }
    return std::nullopt;
}

/// Where a frame has its network layer, and the EtherType that says what it is and may lead on over VLAN
/// tags; if it has none, the version of IP says the rest.
struct LinkLayer {
    std::uint32_t linkType; ///< LINKTYPE_ value, as registered for pcap and pcapng
    std::size_t content;
    std::optional<std::size_t> etherType{};
};

constexpr std::array<LinkLayer, 10> kLinkLayers{{
    {0, 4},      // BSD loopback: an address family of four bytes
    {108, 4},    // OpenBSD loopback
    {1, 14, 12}, // Ethernet
    {12, 0},     // raw IP, by three numbers
    {14, 0},
    {101, 0},
    {228, 0},      // IPv4
    {229, 0},      // IPv6
    {113, 16, 14}, // Linux cooked
    {276, 20, 0},  // Linux cooked, version 2
}};

const LinkLayer* linkLayerOf(std::uint32_t linkType) {
    const auto* const found = std::ranges::find(kLinkLayers, linkType, &LinkLayer::linkType);
    return found == kLinkLayers.end() ? nullptr : found;
}

std::optional<std::size_t> networkOf(std::uint32_t linkType, Frame frame) {
    const LinkLayer* link = linkLayerOf(linkType);
    if (link == nullptr) {
        return std::nullopt;
    }
    return link->etherType ? afterEtherType(frame, *link->etherType, link->content)
                           : std::optional(link->content);
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
    IpPacket found;
    found.sender = addressAt(packet, 12, false);
    found.target = addressAt(packet, 16, false);
    found.protocol = byteAt(packet, 9);
    found.offset = start + headerSize;
    found.bytes = packet.subspan(headerSize, size - headerSize);
    found.identity = wordAt(packet, 4);
    found.fragmentOffset = (flags & 0x1fffU) * 8;
    found.hasMoreFragments = (flags & 0x2000U) != 0;
    return found;
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

constexpr std::size_t kUdpHeader = 8;
constexpr std::size_t kLongest = 0xffff;

/// Appends a number in network order.
void append(std::vector<std::byte>& out, std::size_t value, int size) {
    for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) {
        out.push_back(static_cast<std::byte>(value >> shift & 0xffU));
    }
}

void append(std::vector<std::byte>& out, const IpAddress& address) {
    out.insert(out.end(), address.bytes.begin(), address.bytes.begin() + (address.isIpv6 ? 16 : 4));
}

/// The sum of 16-bit words that a checksum is made of; an odd last byte counts as if a zero followed.
std::uint64_t sumOf(Frame bytes) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        sum += wordAt(bytes, i);
    }
    return bytes.size() % 2 != 0 ? sum + (std::uint64_t{byteAt(bytes, bytes.size() - 1)} << 8) : sum;
}

/// RFC 1071.
std::uint16_t checksumOf(std::uint64_t sum) {
    while (sum >> 16 != 0) {
        sum = (sum >> 16) + (sum & 0xffffU);
    }
    return static_cast<std::uint16_t>(~sum);
}

void appendIpv4(std::vector<std::byte>& out, const IpAddress& sender, const IpAddress& target,
                std::size_t size) {
    constexpr std::size_t headerSize = 20;
    const std::size_t start = out.size();
    append(out, 0x4500, 2);
    append(out, headerSize + size, 2);
    append(out, 0x4000, 4); // one piece
    append(out, 64, 1);
    append(out, kUdp, 1);
    append(out, 0, 2);
    append(out, sender);
    append(out, target);
    wire::store16(out.data() + start + 10, checksumOf(sumOf(std::span(out).subspan(start))));
}

void appendIpv6(std::vector<std::byte>& out, const IpAddress& sender, const IpAddress& target,
                std::size_t size) {
    constexpr unsigned hopByHop = 0;
    const bool isJumbo = size > kLongest;
    append(out, 0x60000000, 4);
    append(out, isJumbo ? 0 : size, 2);
    append(out, isJumbo ? hopByHop : kUdp, 1);
    append(out, 64, 1);
    append(out, sender);
    append(out, target);
    if (isJumbo) {
        append(out, std::size_t{kUdp} << 8, 2);
        append(out, 0xc204, 2);
        append(out, kUdpHeader + size, 4);
    }
}

void appendUdp(std::vector<std::byte>& out, const IpEndpoint& sender, const IpEndpoint& target,
               std::span<const std::byte> payload) {
    const std::size_t start = out.size();
    const std::size_t size = kUdpHeader + payload.size();
    append(out, sender.port, 2);
    append(out, target.port, 2);
    append(out, size > kLongest ? 0 : size, 2);
    append(out, 0, 2);
    out.insert(out.end(), payload.begin(), payload.end());
    // Of an IPv4 address the rest is zeros.
    const std::uint64_t pseudoHeader =
        sumOf(sender.address.bytes) + sumOf(target.address.bytes) + kUdp + (size >> 16) + (size & 0xffffU);
    const std::uint16_t value = checksumOf(pseudoHeader + sumOf(std::span(out).subspan(start)));
    wire::store16(out.data() + start + 6, value != 0 ? value : std::uint16_t{0xffff});
}

IpEndpoint mapped(const IpEndpoint& endpoint) {
    IpEndpoint result{{{}, true}, endpoint.port};
    result.address.bytes[10] = result.address.bytes[11] = std::byte{0xff};
    std::copy_n(endpoint.address.bytes.begin(), 4, result.address.bytes.begin() + 12);
    return result;
}

std::string ipv4Text(const IpAddress& address) {
    std::string text = std::to_string(std::to_integer<unsigned>(address.bytes[0]));
    for (std::size_t i = 1; i < 4; ++i) {
        text.append(1, '.').append(std::to_string(std::to_integer<unsigned>(address.bytes[i])));
    }
    return text;
}

/// RFC 5952: small letters, the longest run of two or more zero groups left out.
std::string bracedIpv6Text(const IpAddress& address) {
    std::size_t longestStart = 8;
    std::size_t longest = 1;
    for (std::size_t i = 0; i < 8; ++i) {
        std::size_t end = i;
        while (end < 8 && wire::load16(address.bytes.data() + 2 * end) == 0) {
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
        const unsigned group = wire::load16(address.bytes.data() + 2 * i);
        std::array<char, 4> digits{};
        text.append(digits.data(), std::to_chars(digits.begin(), digits.end(), group, 16).ptr);
    }
    return text + ']';
}

std::optional<std::uint16_t> parseNumber(std::string_view text, int base, unsigned most) {
    unsigned value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value, base);
    if (stop != end || error != std::errc() || value > most) {
        return std::nullopt;
    }
    return static_cast<std::uint16_t>(value);
}

/// All numbers between separators; empty if one of them is none.
std::optional<std::vector<std::uint16_t>> parseList(std::string_view text, char separator, int base,
                                                    unsigned most) {
    std::vector<std::uint16_t> numbers;
    while (true) {
        const std::size_t end = text.find(separator);
        const auto number = parseNumber(text.substr(0, end), base, most);
        if (!number) {
            return std::nullopt;
        }
        numbers.push_back(*number);
        if (end == std::string_view::npos) {
            return numbers;
        }
        text.remove_prefix(end + 1);
    }
}

std::optional<IpAddress> parseIpv4(std::string_view text) {
    const auto numbers = parseList(text, '.', 10, 255);
    if (!numbers || numbers->size() != 4) {
        return std::nullopt;
    }
    IpAddress address;
    std::ranges::transform(*numbers, address.bytes.begin(),
                           [](std::uint16_t number) { return static_cast<std::byte>(number); });
    return address;
}

std::optional<std::vector<std::uint16_t>> parseGroups(std::string_view text) {
    return text.empty() ? std::vector<std::uint16_t>{} : parseList(text, ':', 16, 0xffff);
}

std::optional<IpAddress> parseIpv6(std::string_view text) {
    text = text.substr(0, text.find('%'));
    const std::size_t gap = text.find("::");
    const bool hasGap = gap != std::string_view::npos;
    const auto head = parseGroups(text.substr(0, gap));
    const auto tail = parseGroups(hasGap ? text.substr(gap + 2) : std::string_view());
    if (!head || !tail) {
        return std::nullopt;
    }
    const std::size_t count = head->size() + tail->size();
    if (hasGap ? count > 7 : count != 8) {
        return std::nullopt;
    }
    IpAddress address{{}, true};
    for (std::size_t i = 0; i < head->size(); ++i) {
        wire::store16(address.bytes.data() + 2 * i, (*head)[i]);
    }
    for (std::size_t i = 0; i < tail->size(); ++i) {
        wire::store16(address.bytes.data() + 2 * (8 - tail->size() + i), (*tail)[i]);
    }
    return address;
}

} // namespace

bool isLinkTypeKnown(std::uint32_t linkType) {
    return linkLayerOf(linkType) != nullptr;
}

std::optional<IpPacket> ipPacketOf(const CapturedFrame& frame) {
    const auto start = networkOf(frame.linkType, frame.bytes);
    if (!start || frame.bytes.size() <= *start) {
        return std::nullopt;
    }
    const unsigned version = byteAt(frame.bytes, *start) >> 4;
    std::optional<IpPacket> packet;
    if (version == 4) {
        packet = throughIpv4(frame.bytes, *start);
    } else if (version == 6) {
        packet = throughIpv6(frame.bytes, *start);
    }
    if (packet) {
        packet->offset += frame.offset;
        packet->time = frame.time;
    }
    return packet;
}

std::optional<UdpPayload> udpPayloadOf(const IpPacket& packet) {
    if (packet.protocol != kUdp || packet.bytes.size() < kUdpHeader) {
        return std::nullopt;
    }
    // A size of 0 is what a card leaves there that cuts the packet itself, as in the header of IP.
    const std::size_t announced = wordAt(packet.bytes, 4);
    const std::size_t size =
        announced >= kUdpHeader ? std::min(announced, packet.bytes.size()) : packet.bytes.size();
    return UdpPayload{packet.offset + kUdpHeader, packet.bytes.subspan(kUdpHeader, size - kUdpHeader),
                      wordAt(packet.bytes, 0), wordAt(packet.bytes, 2)};
}

std::optional<TcpSegment> tcpSegmentOf(const IpPacket& packet) {
    constexpr std::size_t shortest = 20;
    if (packet.bytes.size() < shortest) {
        return std::nullopt;
    }
    const unsigned flags = byteAt(packet.bytes, 13);
    const std::size_t size = (std::size_t{byteAt(packet.bytes, 12)} >> 4) * 4;
    if (size < shortest || size > packet.bytes.size()) {
        return std::nullopt;
    }
    const bool begins = (flags & 2U) != 0;
    return TcpSegment{wordAt(packet.bytes, 0),
                      wordAt(packet.bytes, 2),
                      wire::load32(packet.bytes.data() + 4) + (begins ? 1U : 0U),
                      packet.bytes.subspan(size),
                      packet.offset + size,
                      packet.time,
                      begins,
                      (flags & 5U) != 0,
                      packet.isInOnePiece};
}

void appendUdpFrame(std::vector<std::byte>& out, const IpEndpoint& sender, const IpEndpoint& target,
                    std::span<const std::byte> payload) {
    const std::size_t size = kUdpHeader + payload.size();
    constexpr std::size_t ipv4Header = 20;
    if (sender.address.isIpv6) {
        appendIpv6(out, sender.address, target.address, size);
    } else if (size + ipv4Header <= kLongest) {
        appendIpv4(out, sender.address, target.address, size);
    } else {
        appendUdpFrame(out, mapped(sender), mapped(target), payload);
        return;
    }
    appendUdp(out, sender, target, payload);
}

std::string endpointText(const IpEndpoint& endpoint) {
    const IpAddress& address = endpoint.address;
    return (address.isIpv6 ? bracedIpv6Text(address) : ipv4Text(address)) + ':' +
           std::to_string(endpoint.port);
}

std::optional<IpEndpoint> parseIpEndpoint(std::string_view text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos) {
        return std::nullopt;
    }
    const auto port = parseNumber(text.substr(colon + 1), 10, 0xffff);
    const std::string_view host = text.substr(0, colon);
    const bool isBraced = host.size() > 2 && host.front() == '[' && host.back() == ']';
    const auto address = isBraced ? parseIpv6(host.substr(1, host.size() - 2)) : parseIpv4(host);
    if (!port || !address) {
        return std::nullopt;
    }
    return IpEndpoint{*address, *port};
}

bool isLoopback(const IpAddress& address) {
    IpAddress ipv6{{}, true};
    ipv6.bytes.back() = std::byte{1};
    return address.isIpv6 ? address == ipv6 : address.bytes[0] == std::byte{127};
}

} // namespace posewire::log
