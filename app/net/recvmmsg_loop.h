// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/receive_loop.h"

namespace posewire::net {

/// Linux: many datagrams per system call, written by the kernel straight into the log, with its stamps and
/// its drop counter.
[[nodiscard]] std::unique_ptr<ReceiveLoop> makeRecvmmsgLoop(const ReceiveContext& context);

} // namespace posewire::net
