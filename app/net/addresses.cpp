// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/addresses.h"

#include <QHostAddress>
#include <QHostInfo>
#include <QNetworkInterface>

#include <algorithm>
#include <tuple>

namespace posewire::net {

NetResult<QHostAddress> lookUp(const Endpoint& endpoint) {
    const QString host =
        QString::fromStdString(endpoint.host.empty() ? std::string("127.0.0.1") : endpoint.host);
    if (QHostAddress address(host); !address.isNull()) {
        return address;
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
