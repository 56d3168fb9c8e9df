// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/receive_loop.h"

namespace posewire::net {

/// Receives with Qt Network alone, on any system: no stamps and no drop counters from the kernel.
[[nodiscard]] std::unique_ptr<ReceiveLoop> makeQtReceiveLoop(const ReceiveContext& context);

} // namespace posewire::net
