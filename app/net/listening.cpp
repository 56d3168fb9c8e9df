// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/listening.h"

#include "app/net/port_holder.h"
#include "app/net/socket_options.h"

#include <QNetworkProxy>
#include <QTcpSocket>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace posewire::net {
namespace {

constexpr std::string_view kByAnother = "by another program";

NetResult<std::unique_ptr<QUdpSocket>> bindOne(const QHostAddress& address, const Endpoint& endpoint,
                                               int bufferBytes) {
    auto socket = std::make_unique<QUdpSocket>();
    if (!socket->bind(address, endpoint.port, QUdpSocket::DontShareAddress)) {
        return tl::unexpected(listenError("UDP", endpoint, socket->error(), socket->errorString()));
    }
    socket->setSocketOption(QAbstractSocket::ReceiveBufferSizeSocketOption, bufferBytes);
    return socket;
}

NetResult<std::vector<QHostAddress>> groupsOf(const std::vector<std::string>& texts) {
    std::vector<QHostAddress> groups;
    for (const std::string& text : texts) {
        const QHostAddress group(QString::fromStdString(text));
        if (!group.isMulticast()) {
            return netError(NetError::Kind::BadEndpoint,
                            "\"" + text +
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
            if (isAskedFor || socket.error().kind == NetError::Kind::PortInUse) {
                return tl::unexpected(socket.error());
            }
            continue; // a computer without IPv6
        }
        endpoint.port = (*socket)->localPort();
        UdpSocket bound{std::move(*socket), {}};
        std::ranges::copy_if(groups, std::back_inserter(bound.groups),
                             [&](const QHostAddress& group) { return group.protocol() == protocol; });
        sockets.push_back(std::move(bound));
    }
    return sockets;
}

NetResult<UdpSockets> bindAll(const Endpoint& endpoint, const std::vector<std::string>& groupTexts,
                              int bufferBytes) {
    const auto address = listenAddress(endpoint.host);
    if (!address) {
        return tl::unexpected(address.error());
    }
    auto groups = groupsOf(groupTexts);
    if (!groups) {
        return tl::unexpected(groups.error());
    }
    if (address->isMulticast()) {
        groups->push_back(*address);
        return bindGroups({{}, endpoint.port}, *groups, bufferBytes);
    }
    if (!groups->empty() && !endpoint.host.empty()) {
        return netError(NetError::Kind::BadEndpoint,
                        "a port of " + endpoint.host +
                            " alone receives no multicast; leave the address out to join a group");
    }
    if (!groups->empty()) {
        return bindGroups(endpoint, *groups, bufferBytes);
    }
    auto socket = bindOne(*address, endpoint, bufferBytes);
    if (!socket) {
        return tl::unexpected(socket.error());
    }
    UdpSockets sockets;
    sockets.push_back({std::move(*socket), {}});
    return sockets;
}

} // namespace

NetResult<QHostAddress> listenAddress(const std::string& host) {
    const QHostAddress address =
        host.empty() ? QHostAddress(QHostAddress::Any) : QHostAddress(QString::fromStdString(host));
    if (address.isNull()) {
        return netError(NetError::Kind::BadEndpoint,
                        "\"" + host + "\" is not an IP address to listen on; write one, or leave it out");
    }
    // A group is joined when its interface comes; an address that is not here cannot be listened on.
    if (std::string problem = problemWithZone(address); !problem.empty() && !address.isMulticast()) {
        return netError(NetError::Kind::AddressNotHere, std::move(problem));
    }
    return address;
}

NetError listenError(const std::string& protocol, const Endpoint& endpoint,
                     QAbstractSocket::SocketError error, const QString& systemText) {
    const std::string port = protocol + " port " + std::to_string(endpoint.port) +
                             (endpoint.host.empty() ? std::string() : " of " + endpoint.host);
    switch (error) {
    case QAbstractSocket::AddressInUseError:
        return {NetError::Kind::PortInUse, port + " is in use " + std::string(kByAnother) +
                                               "; close that program or choose another port"};
    case QAbstractSocket::SocketAccessError:
        return {NetError::Kind::NoPermission,
                port + " needs administrator rights; choose a port from 1024 up"};
    case QAbstractSocket::SocketAddressNotAvailableError:
        return {NetError::Kind::AddressNotHere, endpoint.host +
                                                    " is not an address of this computer; leave it out to "
                                                    "listen on all addresses"};
    default:
        if (const QHostAddress host(QString::fromStdString(endpoint.host));
            host.isLinkLocal() && host.scopeId().isEmpty() &&
            error == QAbstractSocket::UnsupportedSocketOperationError) {
            return {NetError::Kind::AddressNotHere,
                    endpoint.host + " may be on every interface; name the one that is meant, as in " +
                        endpoint.host.substr(0, endpoint.host.find('%')) + "%eth0"};
        }
        return {NetError::Kind::Other, "cannot listen on " + port + ": " + systemText.toStdString() +
                                           "; choose another port or address"};
    }
}

NetError withHolder(NetError error, std::uint16_t port, bool isTcp) {
    const std::size_t place = error.text.find(kByAnother);
    if (error.kind != NetError::Kind::PortInUse || place == std::string::npos) {
        return error;
    }
    if (const auto holder = holderOfPort(port, isTcp)) {
        const std::string process = " (process " + std::to_string(holder->id) + ")";
        const bool isOurs = holder->name == "posewire";
        error.text.replace(place, isOurs ? std::string::npos : kByAnother.size(),
                           isOurs
                               ? "by another Posewire" + process +
                                     "; close it, or use another port here and let that Posewire relay to it"
                               : "by " + holder->name + process);
    }
    return error;
}

NetResult<void> listenTcp(QTcpServer& server, const std::string& place) {
    const auto endpoint = parseEndpoint(place);
    if (!endpoint) {
        return tl::unexpected(endpoint.error());
    }
    const auto address = listenAddress(endpoint->host.empty() ? "127.0.0.1" : endpoint->host);
    if (!address) {
        return tl::unexpected(address.error());
    }
    server.setProxy(QNetworkProxy::NoProxy);
    if (!server.listen(*address, endpoint->port)) {
        return tl::unexpected(withHolder(
            listenError("TCP", *endpoint, server.serverError(), server.errorString()), endpoint->port, true));
    }
    return {};
}

NetResult<std::string> freeTcpPlace(const std::string& place) {
    QTcpServer server;
    if (const auto listening = listenTcp(server, place); !listening) {
        return tl::unexpected(listening.error());
    }
    return textOf(server.serverAddress(), server.serverPort());
}

void knock(const std::string& place) {
    constexpr int kPatience = 100; // milliseconds
    if (const auto endpoint = parseEndpoint(place)) {
        QTcpSocket socket;
        socket.setProxy(QNetworkProxy::NoProxy);
        socket.connectToHost(QString::fromStdString(endpoint->host), endpoint->port);
        socket.waitForConnected(kPatience);
    }
}

NetResult<UdpSockets> bindUdp(Input& input, int bufferBytes) {
    const InputStatus asked = input.status();
    auto sockets = bindAll(asked.endpoint, asked.groups, bufferBytes);
    if (sockets) {
        input.setPort(sockets->front().socket->localPort());
        input.counters().receiveBufferBytes = receiveBufferBytes(*sockets->front().socket);
    }
    return sockets;
}

} // namespace posewire::net
