// SPDX-License-Identifier: MIT
#include "core/log/ip_address.h"

#include "core/wire/byte_order.h"

#include <algorithm>
#include <charconv>
#include <vector>

namespace posewire::log {
namespace {

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
