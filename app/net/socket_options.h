// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTcpSocket>
#include <QUdpSocket>

/// What Qt has no option for, or gives as the system has it.
namespace posewire::net {

/// The receive buffer that was granted, in the bytes that were asked for.
[[nodiscard]] int receiveBufferBytes(QUdpSocket& socket);

/// Has the system find out within a minute that the other end is gone, if it can be told so; else it takes
/// its own time, usually two hours.
void keepAlive(QTcpSocket& socket);

} // namespace posewire::net
