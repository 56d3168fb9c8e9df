// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"
#include "core/log/packet.h"
#include "core/log/time.h"

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

namespace posewire::log {

/// What a recording says about itself; what is empty is left out.
struct RecordingInfo {
    std::string hardware;
    std::string system;
    std::string application;
};

/// Writes packets as pcapng (draft-ietf-opsawg-pcapng): a section header, one interface with nanosecond
/// stamps, an enhanced packet block for each packet, interface statistics at the end. Each packet gets IP and
/// UDP headers that are made up from its sender; what they cannot hold (TCP, a file name, flags) is in a
/// comment, see RecordedOrigin. readFile() gives back the same packets: bytes, stamps from 1970 on, senders,
/// kernel drops, flags, comments. `sink` must outlive the writer. After a failure nothing more is written.
class PcapngWriter {
public:
    using Result = tl::expected<void, FileError>;

    explicit PcapngWriter(ByteSink& sink) : m_sink(sink) {}

    /// First of all.
    Result begin(const RecordingInfo& info);

    /// `comments`: UTF-8; what is longer than 65,000 bytes is cut.
    Result add(const Packet& packet, const SenderInfo& sender, std::span<const std::string> comments = {});

    /// Last of all.
    Result finish();

    [[nodiscard]] std::uint64_t packets() const { return m_packets; }
    [[nodiscard]] std::uint64_t bytes() const { return m_bytes; } ///< of the file so far

private:
    Result write();

    ByteSink& m_sink;
    std::vector<std::byte> m_block;
    std::vector<std::byte> m_frame;
    std::uint64_t m_packets = 0;
    std::uint64_t m_bytes = 0;
    std::uint64_t m_kernelDrops = 0;
    Stamp m_firstStamp = Stamp::max();
    Stamp m_lastStamp{};
};

} // namespace posewire::log
