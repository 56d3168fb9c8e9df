// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/endpoint.h"

#include <QHostAddress>
#include <QHostInfo>
#include <QNetworkInterface>

#include <algorithm>
#include <charconv>
#include <tuple>

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

NetResult<Endpoint> parseTarget(std::string_view text) {
    auto endpoint = parseEndpoint(text);
    if (endpoint && endpoint->port == 0) {
        return netError(NetError::Kind::BadEndpoint,
                        std::string(text) + ": nobody can listen to port 0; write one from 1 to 65535");
    }
    return endpoint;
}

NetResult<QHostAddress> lookUp(const Endpoint& endpoint) {
    const QString host =
        QString::fromStdString(endpoint.host.empty() ? std::string("127.0.0.1") : endpoint.host);
    if (QHostAddress address(host); !address.isNull()) {
        std::string problem = problemWithZone(address);
        return problem.empty() ? NetResult<QHostAddress>(address)
                               : netError(NetError::Kind::AddressNotHere, std::move(problem));
    }
    const QHostInfo info = QHostInfo::fromName(host);
    if (info.addresses().isEmpty()) {
        return netError(NetError::Kind::HostNotFound, "no computer named " + endpoint.host +
                                                          " was found; check the name or use its address");
    }
    const auto addresses = info.addresses();
    const auto ipv4 = std::ranges::find(addresses, QAbstractSocket::IPv4Protocol, &QHostAddress::protocol);
    return ipv4 == addresses.end() ? addresses.front() : *ipv4;
}

QNetworkInterface zoneOf(const QHostAddress& address) {
    const QString zone = address.scopeId();
    bool isIndex = false;
    const int index = zone.toInt(&isIndex);
    if (isIndex) {
        return QNetworkInterface::interfaceFromIndex(index);
    }
    return zone.isEmpty() ? QNetworkInterface() : QNetworkInterface::interfaceFromName(zone);
}

std::string problemWithZone(const QHostAddress& address) {
    if (address.scopeId().isEmpty() || zoneOf(address).isValid()) {
        return {};
    }
    std::string names;
    for (const QNetworkInterface& interface : QNetworkInterface::allInterfaces()) {
        names += (names.empty() ? "" : ", ") + interface.name().toStdString();
    }
    return address.toString().toStdString() + ": there is no interface " + address.scopeId().toStdString() +
           " here; write one of those that there are after the % (" + names + ")";
}

std::string textOf(const QHostAddress& address, std::uint16_t port) {
    bool isIpv4 = false;
    const QHostAddress ipv4(address.toIPv4Address(&isIpv4));
    return textOf(Endpoint{(isIpv4 ? ipv4 : address).toString().toStdString(), port});
}

std::vector<LocalAddress> localAddresses() {
    std::vector<LocalAddress> result;
    for (const QNetworkInterface& interface : QNetworkInterface::allInterfaces()) {
        if (!interface.flags().testFlag(QNetworkInterface::IsUp)) {
            continue;
        }
        for (const QNetworkAddressEntry& entry : interface.addressEntries()) {
            const QHostAddress address = entry.ip();
            result.push_back({address.toString().toStdString(), interface.humanReadableName().toStdString(),
                              address.protocol() == QAbstractSocket::IPv4Protocol, address.isLoopback(),
                              address.isLinkLocal()});
        }
    }
    return result;
}

std::vector<LocalAddress> reachable(std::vector<LocalAddress> addresses) {
    const bool hasOther =
        std::ranges::any_of(addresses, [](const LocalAddress& address) { return !address.isLoopback; });
    if (hasOther) {
        std::erase_if(addresses, [](const LocalAddress& address) { return address.isLoopback; });
    }
    std::ranges::stable_sort(addresses, {}, [](const LocalAddress& address) {
        return std::tuple(address.isLinkLocal, !address.isIpv4);
    });
    return addresses;
}

} // namespace posewire::net
