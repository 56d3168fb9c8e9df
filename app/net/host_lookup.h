// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/net_error.h"

#include <QHostAddress>

namespace posewire::net {

/// The address of a host, IPv4 if it has both; this computer's if the host is empty. Blocks while a name is
/// resolved.
[[nodiscard]] NetResult<QHostAddress> lookUp(const Endpoint& endpoint);

} // namespace posewire::net
