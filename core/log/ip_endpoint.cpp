// SPDX-License-Identifier: MIT
#include "core/log/ip_endpoint.h"

#include "core/wire/byte_order.h"

#include <algorithm>
#include <charconv>
#include <vector>

namespace posewire::log {
namespace {

std::optional<std::uint16_t> parseNumber(std::string_view text, int base, unsigned most) {
    unsigned value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value, base);
    if (text.empty() || stop != end || error != std::errc() || value > most) {
        return std::nullopt;
    }
    return static_cast<std::uint16_t>(value);
}

/// All numbers between separators; nothing where one of them is none.
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
    return addressText(endpoint.address) + ':' + std::to_string(endpoint.port);
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
    if (!address.isIpv6) {
        return address.bytes[0] == std::byte{127};
    }
    return std::all_of(address.bytes.begin(), address.bytes.end() - 1,
                       [](std::byte byte) { return byte == std::byte{}; }) &&
           address.bytes.back() == std::byte{1};
}

} // namespace posewire::log
