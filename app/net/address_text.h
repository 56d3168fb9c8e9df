// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QHostAddress>

#include <string>

namespace posewire::net {

/// An address as the operator writes it: IPv4 in its own form even where an IPv6 socket received it.
inline std::string addressText(const QHostAddress& address) {
    bool isIpv4 = false;
    const QHostAddress ipv4(address.toIPv4Address(&isIpv4));
    return (isIpv4 ? ipv4 : address).toString().toStdString();
}

} // namespace posewire::net
