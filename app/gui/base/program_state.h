// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/input_choices.h"
#include "app/net/connection_help.h"
#include "app/net/endpoint.h"
#include "app/net/input.h"
#include "app/stage/stage_reader.h"
#include "core/log/time.h"

#include <QString>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::gui {

struct PortState {
    InputAddress port;
    QString problem;                  ///< why nothing can come from it now, and what to do; empty if it can
    std::optional<net::InputId> id{}; ///< once it is open
    net::InputStatus status{};        ///< of an open one, as last measured
    double datagramsPerSecond = 0;
};

struct WayOutState {
    enum class Stage : std::uint8_t { Off, LookingUp, Forwarding, Refused };
    WayOut target;
    Stage stage = Stage::Off;
    QString problem{};      ///< why it or its newest datagrams were refused, or that no program listens there
    std::uint64_t sent = 0; ///< datagrams or lines
    std::uint64_t refused = 0; ///< datagrams that this system did not take, or nobody there
    std::uint64_t skipped = 0; ///< datagrams left out: fallen too far behind, or for fear of a loop
    std::uint64_t behind = 0;  ///< packets that wait to be forwarded
    std::size_t receivers = 0; ///< now, of those that they connect to
    std::string form{};        ///< the title of its kind
};

struct ReceivingState {
    std::vector<PortState> ports;
    std::uint64_t kernelDropped = 0;     ///< in this computer, by the kernel or by the queue of the receiver
    log::KernelCounters kernel{};        ///< since this program was started
    std::uint64_t refusedDatagrams = 0;  ///< from those who are not listened to
    QString allowedProblem{};            ///< a host to listen to whose name is not known; empty for none
    std::int64_t receiveBufferBytes = 0; ///< the smallest that a UDP port was granted; 0 without one
    log::Duration longestDelay{}; ///< the longest time the receiving thread did not look at its sockets
    double datagramsPerSecond = 0;
    double bytesPerSecond = 0;
    std::vector<WayOutState> waysOut{};
    QString stage{}; ///< the site whose probes are read; empty for none
    std::vector<stage::ProbeState> probes{};
    QString stageProblem{}; ///< why no server of the stage answers; empty if one does, or none is asked
    std::vector<words::Fact> findings{};        ///< why no characters are seen; empty if all is well
    std::vector<net::LocalAddress> addresses{}; ///< of this computer, to type into a sender, the best first
};

struct PictureHealth {
    QString state{}; ///< empty before there was one
    QString why{};
    bool isPoor = false; ///< what is left out may be missed
};

/// How this program itself is doing, measured a few times a second; nothing if the system does not report
/// it. Shares of a processor are of one core: 1.5 is one and a half.
struct MonitorHealth {
    std::optional<double> bufferFill{};    ///< share of the fullest receive buffer, the most since before
    std::optional<double> receiverShare{}; ///< of a core, by the receiving thread
    std::optional<double> processShare{};  ///< of a core, by all threads
    std::optional<std::uint64_t> memoryBytes{}; ///< of this process, in main memory
    double followUsPerPacket = 0;  ///< to read, count and explain a packet; 0 before there was one
    double followShare = 0;        ///< of the window's thread, spent on that
    double framesPerSecond = 0;    ///< pictures of the viewport
    std::size_t meshBytes = 0;     ///< of the bodies in the viewport
    std::size_t mostMeshBytes = 0; ///< what that can become
    PictureHealth picture{};
};

} // namespace posewire::gui
