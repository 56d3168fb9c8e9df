// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/host_lookup.h"

#include <QHostInfo>

#include <algorithm>

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

} // namespace posewire::net
