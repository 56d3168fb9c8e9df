// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

namespace posewire::gui {

/// How this program itself is doing, measured a few times a second; nothing where the system does not report
/// it. Shares of a processor are of one core: 1.5 is one and a half.
struct MonitorHealth {
    std::optional<double> bufferFill{};    ///< share of the fullest receive buffer, the most since before
    std::optional<double> receiverShare{}; ///< of a core, by the receiving thread
    std::optional<double> processShare{};  ///< of a core, by all threads
    std::optional<std::uint64_t> memoryBytes{}; ///< of this process, in main memory
    double followUsPerPacket = 0; ///< to read, count and explain a packet; 0 before there was one
    double followShare = 0;       ///< of the window's thread, spent on that
    double framesPerSecond = 0;   ///< pictures of the viewport
};

} // namespace posewire::gui
