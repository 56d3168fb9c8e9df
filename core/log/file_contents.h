// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace posewire::log {

/// What a file holds, counted while it is read: for what is said where it holds nothing of ours.
struct FileContents {
    enum class Format : std::uint8_t { Raw, Compressed, Capture };
    Format format = Format::Raw;
    bool isEmpty = true;
    std::uint64_t datagrams = 0; ///< that begin with "MXTP"

    // Of captures, in packets.
    std::uint64_t packets = 0;
    std::uint64_t withoutIp = 0;    ///< or damaged, or carrying neither UDP nor TCP
    std::uint64_t ofOtherLinks = 0; ///< of a link type that is not looked through
    std::uint32_t otherLink = 0;    ///< the first one of these, as registered for pcap
    std::uint64_t udp = 0;
    std::uint64_t tcp = 0;
};

/// What it holds instead of MXTP and what to do, as it follows the name of the file; empty if it has MXTP.
[[nodiscard]] std::string otherContents(const FileContents& contents);

} // namespace posewire::log
