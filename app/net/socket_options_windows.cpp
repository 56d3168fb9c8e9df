// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/socket_options.h"

#include <QVariant>

#include <winsock2.h>

#include <mstcpip.h>

namespace posewire::net {

int receiveBufferBytes(QUdpSocket& socket) {
    return socket.socketOption(QAbstractSocket::ReceiveBufferSizeSocketOption).toInt();
}

/// Windows asks ten times before it gives up.
void keepAlive(QTcpSocket& socket) {
    socket.setSocketOption(QAbstractSocket::KeepAliveOption, 1);
    tcp_keepalive times{};
    times.onoff = 1;
    times.keepalivetime = 30'000;    // ms of silence before it asks
    times.keepaliveinterval = 3'000; // ms between two questions
    DWORD ignored = 0;
    ::WSAIoctl(static_cast<SOCKET>(socket.socketDescriptor()), SIO_KEEPALIVE_VALS, &times, sizeof times,
               nullptr, 0, &ignored, nullptr, nullptr);
}

} // namespace posewire::net
