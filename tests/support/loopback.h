// SPDX-License-Identifier: MIT
#pragma once

#include <QHostAddress>
#include <QUdpSocket>

namespace posewire::test {

/// Whether a socket of 127.0.0.2 sends from there, so that one computer can be several senders. Under Wine it
/// sends from 127.0.0.1.
inline bool hasManyLoopbackAddresses() {
    QUdpSocket from;
    QUdpSocket to;
    const QHostAddress second(QStringLiteral("127.0.0.2"));
    if (!from.bind(second, 0) || !to.bind(QHostAddress::LocalHost, 0)) {
        return false;
    }
    from.writeDatagram("?", 1, QHostAddress::LocalHost, to.localPort());
    char byte = 0;
    QHostAddress sender;
    return to.waitForReadyRead(2000) && to.readDatagram(&byte, 1, &sender) == 1 && sender.isEqual(second);
}

} // namespace posewire::test
