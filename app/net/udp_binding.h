// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/net_error.h"

#include <QUdpSocket>

#include <memory>

namespace posewire::net {

/// A socket that nobody shares, bound in the calling thread, with a receive buffer of `bufferBytes` asked
/// for. Every failure says what to do about it: a port in use is told with its holder where the system gives
/// it away.
[[nodiscard]] NetResult<std::unique_ptr<QUdpSocket>> bindUdp(const Endpoint& endpoint, int bufferBytes);

/// The receive buffer that was granted, in bytes of the caller's arithmetic: Linux counts its own overhead
/// and says double.
[[nodiscard]] int receiveBufferBytes(QUdpSocket& socket);

} // namespace posewire::net
