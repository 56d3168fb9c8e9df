// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/input.h"
#include "app/net/net_error.h"

#include <QUdpSocket>

#include <memory>
#include <vector>

namespace posewire::net {

/// The sockets of one input, all with the same port: one, or one for IPv4 and one for IPv6 where there are
/// multicast groups, since a socket for both joins no IPv4 groups on all systems.
using UdpSockets = std::vector<std::unique_ptr<QUdpSocket>>;

/// Sockets that nobody shares, bound in the calling thread, with a receive buffer of `bufferBytes` asked for
/// each, members of their groups. Every failure says what to do about it.
[[nodiscard]] NetResult<UdpSockets> bindUdp(const UdpInput& where, int bufferBytes);

/// The error with the holder of the port named, where the port is in use and the system gives it away.
[[nodiscard]] NetError withHolder(NetError error, std::uint16_t port, bool isTcp);

/// The receive buffer that was granted, in bytes of the caller's arithmetic: Linux counts its own overhead
/// and says double.
[[nodiscard]] int receiveBufferBytes(QUdpSocket& socket);

} // namespace posewire::net
