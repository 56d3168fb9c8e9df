// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/options.h"
#include "app/net/input.h"

#include <QString>

#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::gui {

/// One input that the operator wants to hear.
struct PortState {
    InputAddress port;
    QString problem; ///< why nothing can come from it now, and what to do; empty where it can
    std::optional<net::InputId> id{}; ///< once it is open
    net::InputStatus status{};        ///< of an open one, as last measured
};

/// What there is to say about receiving.
struct ReceivingState {
    std::vector<PortState> ports;
    QString file;                        ///< shown instead of ports, or beside them
    std::uint64_t kernelDropped = 0;     ///< in this computer, by the kernel or by the queue of the receiver
    std::int64_t receiveBufferBytes = 0; ///< the smallest that a UDP port was granted; 0 without one
    std::int64_t longestDelayNs = 0; ///< the longest time the receiving thread did not look at its sockets
    double datagramsPerSecond = 0;
    double bytesPerSecond = 0;
};

} // namespace posewire::gui
