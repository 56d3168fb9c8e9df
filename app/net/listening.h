// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/input.h"

#include <QAbstractSocket>
#include <QHostAddress>
#include <QTcpServer>
#include <QUdpSocket>

#include <memory>
#include <vector>

/// Opening sockets that listen. Why one cannot is said in the same words for UDP and TCP.
namespace posewire::net {

/// The address to listen on; every one of this computer where the host is empty.
[[nodiscard]] NetResult<QHostAddress> listenAddress(const std::string& host);

/// `protocol` is "UDP" or "TCP", `systemText` what the system says about errors that are not expected.
[[nodiscard]] NetError listenError(const std::string& protocol, const Endpoint& endpoint,
                                   QAbstractSocket::SocketError error, const QString& systemText);

/// The error with the port's holder named, if the port is in use and the system reveals who has it.
[[nodiscard]] NetError withHolder(NetError error, std::uint16_t port, bool isTcp);

/// Listens at "ADDRESS:PORT", or "PORT" for this computer alone; port 0 is one that is free.
[[nodiscard]] NetResult<void> listenTcp(QTcpServer& server, const std::string& place);

/// Returns such a place for a library that listens by itself: "127.0.0.1:9464", where no program listens yet.
[[nodiscard]] NetResult<std::string> freeTcpPlace(const std::string& place);

/// Connects to such a place and leaves at once: whoever waits there for connections wakes up.
void knock(const std::string& place);

struct UdpSocket {
    std::unique_ptr<QUdpSocket> socket;
    std::vector<QHostAddress> groups; ///< to be joined with it
};

/// The sockets of one input, all on the same port: one, or one each for IPv4 and IPv6 if there are multicast
/// groups, since not every system lets a dual-stack socket join IPv4 groups.
using UdpSockets = std::vector<UdpSocket>;

/// Unshared sockets, bound in the calling thread, that have requested a receive buffer of `bufferBytes` each.
/// Sets the input's port and the buffer that was granted. Every error says what to do about it.
[[nodiscard]] NetResult<UdpSockets> bindUdp(Input& input, int bufferBytes);

} // namespace posewire::net
