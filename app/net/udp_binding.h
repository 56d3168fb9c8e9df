// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/input.h"
#include "app/net/net_error.h"

#include <QUdpSocket>

#include <memory>
#include <vector>

namespace posewire::net {

/// The sockets of one input, all on the same port: one, or one each for IPv4 and IPv6 if there are multicast
/// groups, since not every system lets a dual-stack socket join IPv4 groups.
using UdpSockets = std::vector<std::unique_ptr<QUdpSocket>>;

/// Unshared sockets, bound in the calling thread, that have requested a receive buffer of `bufferBytes` each
/// and joined their groups. Every error says what to do about it.
[[nodiscard]] NetResult<UdpSockets> bindUdp(const UdpInput& where, int bufferBytes);

/// The granted receive buffer in the bytes that were requested: Linux adds its own overhead and reports
/// double.
[[nodiscard]] int receiveBufferBytes(QUdpSocket& socket);

} // namespace posewire::net
