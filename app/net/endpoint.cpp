// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/endpoint.h"

#include <charconv>

namespace posewire::net {
namespace {

bool parsePort(std::string_view text, std::uint16_t& port) {
    const char* end = text.data() + text.size();
    const auto [stop, fault] = std::from_chars(text.data(), end, port);
    return fault == std::errc{} && stop == end;
}

tl::unexpected<NetError> badEndpoint(std::string_view text) {
    std::string message(text);
    message +=
        " is not an address and port; write PORT, HOST:PORT or [IPv6]:PORT, with a port from 0 to 65535";
    return netError(NetError::Kind::BadEndpoint, std::move(message));
}

} // namespace

std::string textOf(const Endpoint& endpoint) {
    const bool isIpv6 = endpoint.host.find(':') != std::string::npos;
    std::string text = isIpv6 ? "[" : "";
    text += endpoint.host;
    text += isIpv6 ? "]:" : ":";
    text += std::to_string(endpoint.port);
    return text;
}

NetResult<Endpoint> parseEndpoint(std::string_view text) {
    Endpoint endpoint;
    const std::size_t colon = text.rfind(':');
    const std::string_view port = colon == std::string_view::npos ? text : text.substr(colon + 1);
    std::string_view host = colon == std::string_view::npos ? std::string_view{} : text.substr(0, colon);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
        host = host.substr(1, host.size() - 2);
    } else if (host.find_first_of(":[]") != std::string_view::npos) {
        return badEndpoint(text);
    }
    if (!parsePort(port, endpoint.port)) {
        return badEndpoint(text);
    }
    endpoint.host = host;
    return endpoint;
}

} // namespace posewire::net
