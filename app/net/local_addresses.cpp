// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/local_addresses.h"

#include <QHostAddress>
#include <QNetworkInterface>

#include <algorithm>
#include <tuple>

namespace posewire::net {

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
