// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/udp_binding.h"

#include "app/net/listen_error.h"

#include <QNetworkInterface>
#include <QVariant>

#include <algorithm>

namespace posewire::net {

namespace {

using Kind = NetError::Kind;

NetResult<std::unique_ptr<QUdpSocket>> bindOne(const QHostAddress& address, const Endpoint& endpoint,
                                               int bufferBytes) {
    auto socket = std::make_unique<QUdpSocket>();
    if (!socket->bind(address, endpoint.port, QUdpSocket::DontShareAddress)) {
        return tl::unexpected(listenError("UDP", endpoint, socket->error(), socket->errorString()));
    }
    socket->setSocketOption(QAbstractSocket::ReceiveBufferSizeSocketOption, bufferBytes);
    return socket;
}

/// Joins on every interface that is up, since the sender may be reached by any.
NetResult<void> join(QUdpSocket& socket, const QHostAddress& group) {
    int joined = 0;
    for (const QNetworkInterface& interface : QNetworkInterface::allInterfaces()) {
        const auto flags = interface.flags();
        const bool canMulticast =
            flags.testFlag(QNetworkInterface::CanMulticast) || flags.testFlag(QNetworkInterface::IsLoopBack);
        if (flags.testFlag(QNetworkInterface::IsUp) && canMulticast) {
            joined += socket.joinMulticastGroup(group, interface) ? 1 : 0;
        }
    }
    if (joined == 0) {
        return netError(Kind::Other, "cannot join the multicast group " + group.toString().toStdString() +
                                         " on any network interface; check that the network is connected");
    }
    return {};
}

NetResult<std::vector<QHostAddress>> groupsOf(const UdpInput& where) {
    std::vector<QHostAddress> groups;
    for (const std::string& text : where.groups) {
        const QHostAddress group(QString::fromStdString(text));
        if (!group.isMulticast()) {
            return netError(Kind::BadEndpoint, "\"" + text +
                                                   "\" is not a multicast group; those are 224.0.0.0 to "
                                                   "239.255.255.255 and addresses that begin with ff");
        }
        groups.push_back(group);
    }
    return groups;
}

NetResult<UdpSockets> bindGroups(Endpoint endpoint, const std::vector<QHostAddress>& groups,
                                 int bufferBytes) {
    using Protocol = QAbstractSocket::NetworkLayerProtocol;
    UdpSockets sockets;
    for (const Protocol protocol : {Protocol::IPv4Protocol, Protocol::IPv6Protocol}) {
        const bool isIpv4 = protocol == Protocol::IPv4Protocol;
        const bool isAskedFor = std::ranges::find(groups, protocol, &QHostAddress::protocol) != groups.end();
        auto socket = bindOne(isIpv4 ? QHostAddress::AnyIPv4 : QHostAddress::AnyIPv6, endpoint, bufferBytes);
        if (!socket) {
            if (isAskedFor || socket.error().kind == Kind::PortInUse) {
                return tl::unexpected(socket.error());
            }
            continue; // a computer without IPv6
        }
        endpoint.port = (*socket)->localPort();
        for (const QHostAddress& group : groups) {
            if (group.protocol() != protocol) {
                continue;
            }
            if (const auto joined = join(**socket, group); !joined) {
                return tl::unexpected(joined.error());
            }
        }
        sockets.push_back(std::move(*socket));
    }
    return sockets;
}

} // namespace

NetResult<UdpSockets> bindUdp(const UdpInput& where, int bufferBytes) {
    const auto address = listenAddress(where.endpoint.host);
    if (!address) {
        return tl::unexpected(address.error());
    }
    auto groups = groupsOf(where);
    if (!groups) {
        return tl::unexpected(groups.error());
    }
    if (address->isMulticast()) {
        groups->push_back(*address);
        return bindGroups({{}, where.endpoint.port}, *groups, bufferBytes);
    }
    if (!groups->empty() && !where.endpoint.host.empty()) {
        return netError(Kind::BadEndpoint,
                        "a port of " + where.endpoint.host +
                            " alone receives no multicast; leave the address out to join a group");
    }
    if (!groups->empty()) {
        return bindGroups(where.endpoint, *groups, bufferBytes);
    }
    auto socket = bindOne(*address, where.endpoint, bufferBytes);
    if (!socket) {
        return tl::unexpected(socket.error());
    }
    UdpSockets sockets;
    sockets.push_back(std::move(*socket));
    return sockets;
}

int receiveBufferBytes(QUdpSocket& socket) {
    const int bytes = socket.socketOption(QAbstractSocket::ReceiveBufferSizeSocketOption).toInt();
#ifdef __linux__
    return bytes / 2;
#else
    return bytes;
#endif
}

} // namespace posewire::net
