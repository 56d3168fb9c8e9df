// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/udp_binding.h"

#include "app/net/port_holder.h"

#include <QHostAddress>
#include <QVariant>

namespace posewire::net {

namespace {

std::string portText(const Endpoint& endpoint) {
    const std::string port = "UDP port " + std::to_string(endpoint.port);
    return endpoint.host.empty() ? port : port + " of " + endpoint.host;
}

tl::unexpected<NetError> bindError(const QUdpSocket& socket, const Endpoint& endpoint) {
    using Kind = NetError::Kind;
    switch (socket.error()) {
    case QAbstractSocket::AddressInUseError: {
        const auto holder = holderOfUdpPort(endpoint.port);
        const std::string by = holder ? "by " + holder->name + " (process " + std::to_string(holder->id) + ")"
                                      : std::string("by another program");
        return netError(Kind::PortInUse, portText(endpoint) + " is in use " + by +
                                             "; close that program or choose another port");
    }
    case QAbstractSocket::SocketAccessError:
        return netError(Kind::NoPermission,
                        portText(endpoint) + " may not be opened by this user; choose a port from 1024 on");
    case QAbstractSocket::SocketAddressNotAvailableError:
        return netError(Kind::AddressNotHere, endpoint.host +
                                                  " is not an address of this computer; leave it out to "
                                                  "listen on all addresses");
    default:
        return netError(Kind::Other, "cannot listen on " + portText(endpoint) + ": " +
                                         socket.errorString().toStdString() +
                                         "; choose another port or address");
    }
}

} // namespace

NetResult<std::unique_ptr<QUdpSocket>> bindUdp(const Endpoint& endpoint, int bufferBytes) {
    const QHostAddress address = endpoint.host.empty() ? QHostAddress(QHostAddress::Any)
                                                       : QHostAddress(QString::fromStdString(endpoint.host));
    if (address.isNull()) {
        return netError(NetError::Kind::BadEndpoint,
                        "\"" + endpoint.host +
                            "\" is not an IP address to listen on; write one, or leave it out");
    }
    auto socket = std::make_unique<QUdpSocket>();
    if (!socket->bind(address, endpoint.port, QUdpSocket::DontShareAddress)) {
        return bindError(*socket, endpoint);
    }
    socket->setSocketOption(QAbstractSocket::ReceiveBufferSizeSocketOption, bufferBytes);
    return socket;
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
