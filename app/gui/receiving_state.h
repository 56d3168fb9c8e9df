// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/options.h"

#include <QString>

#include <cstdint>
#include <vector>

namespace posewire::gui {

/// One port that the operator wants to hear.
struct PortState {
    UdpPort port;
    QString problem; ///< why it is not open, and what to do; empty where it is
};

/// What there is to say about receiving.
struct ReceivingState {
    std::vector<PortState> ports;
    QString file; ///< shown instead of ports, or beside them
    std::uint64_t kernelDropped = 0;
    std::int64_t receiveBufferBytes = 0;
    double datagramsPerSecond = 0;
    double bytesPerSecond = 0;
};

} // namespace posewire::gui
