// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

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

/// Builds one block in a buffer that is used again and again; little-endian.
class PcapngBlock {
public:
    /// Begins the block; `buffer` is cleared.
    PcapngBlock(std::vector<std::byte>& buffer, PcapngBlockType type);

    void number(std::uint64_t value, std::size_t size);
    /// A stamp, or any number of 64 bits of which the upper half comes first.
    void halves(std::uint64_t value);
    /// Followed by what is missing to a multiple of four bytes.
    void padded(std::span<const std::byte> bytes);

    /// Nothing where `text` is empty.
    void option(PcapngOption code, std::string_view text);
    void option(PcapngOption code, std::span<const std::byte> bytes);
    void option(PcapngOption code, std::uint64_t value);

    /// Ends the list of options, if there were any, and the block.
    void finish();

private:
    std::vector<std::byte>& m_buffer;
    bool m_hasOptions = false;
};

} // namespace posewire::log
