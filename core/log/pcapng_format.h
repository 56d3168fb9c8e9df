// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace posewire::log {

enum class PcapngBlockType : std::uint32_t {
    SectionHeader = 0x0a0d0d0a,
    Interface = 1,
    SimplePacket = 3,
    InterfaceStatistics = 5,
    EnhancedPacket = 6,
};

/// Option codes; most count only within their type of block.
enum class PcapngOption : std::uint16_t {
    End = 0,
    Comment = 1,

    Hardware = 2, ///< of a section header
    System = 3,
    Application = 4,

    InterfaceName = 2,
    InterfaceDescription = 3,
    StampResolution = 9,
    StampOffset = 14,

    DropCount = 4, ///< of an enhanced packet: lost between the packet before it and this one

    StartTime = 2, ///< of interface statistics
    EndTime = 3,
    Received = 4,
    DroppedBySystem = 7,
    Delivered = 8,
};

/// What a recording says about a packet besides what its IP and UDP headers can. It is in the first
/// comment of the packet, in words: "Posewire: TCP; stamped on reading; from [fe80::1%eth0]:40001".
struct RecordedOrigin {
    Transport transport = Transport::Udp;
    PacketFlags flags{.stampedByKernel = true};
    std::optional<std::string> address{}; ///< nothing where the headers have it

    friend bool operator==(const RecordedOrigin&, const RecordedOrigin&) = default;
};

[[nodiscard]] std::string originText(const RecordedOrigin& origin);

/// The inverse; nothing where somebody else wrote the comment.
[[nodiscard]] std::optional<RecordedOrigin> parseOrigin(std::string_view comment);

} // namespace posewire::log
