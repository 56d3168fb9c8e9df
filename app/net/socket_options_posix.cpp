// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/socket_options.h"

#include <QVariant>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace posewire::net {

int receiveBufferBytes(QUdpSocket& socket) {
    const int bytes = socket.socketOption(QAbstractSocket::ReceiveBufferSizeSocketOption).toInt();
#ifdef __linux__
    return bytes / 2; // Linux adds its own overhead and reports double
#else
    return bytes;
#endif
}

void keepAlive(QTcpSocket& socket) {
    socket.setSocketOption(QAbstractSocket::KeepAliveOption, 1);
#ifdef TCP_KEEPIDLE
    const auto descriptor = static_cast<int>(socket.socketDescriptor());
    const auto set = [descriptor](int option, int value) {
        ::setsockopt(descriptor, IPPROTO_TCP, option, &value, sizeof value);
    };
    set(TCP_KEEPIDLE, 30);  // seconds of silence before it asks
    set(TCP_KEEPINTVL, 10); // seconds between two questions
    set(TCP_KEEPCNT, 3);    // questions without an answer
#endif
}

} // namespace posewire::net
