// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/net_error.h"

#include <QHostAddress>

namespace posewire::net {

/// The address of a host, IPv4 where it has both; of this computer where the host is empty. Waits for the
/// answer of the name service where a name is given.
[[nodiscard]] NetResult<QHostAddress> lookUp(const Endpoint& endpoint);

} // namespace posewire::net
