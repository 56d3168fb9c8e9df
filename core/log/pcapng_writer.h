// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"
#include "core/log/packet.h"
#include "core/log/time.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
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

/// What a recording says about a packet besides what its IP and UDP headers can. It is in the first
/// comment of the packet, in words: "Posewire: TCP; clock set by -1.500000000 s; from [fe80::1%eth0]:40001".
struct RecordedOrigin {
    Transport transport = Transport::Udp;
    PacketFlags flags{.stampedByKernel = true};
    std::optional<std::string> address{}; ///< empty if the headers have it
    Duration setBy{};                     ///< what the clock had been set by since the recording began
    std::string probe{};                  ///< that received it, see SenderInfo; has no semicolon

    friend bool operator==(const RecordedOrigin&, const RecordedOrigin&) = default;
};

[[nodiscard]] std::string originText(const RecordedOrigin& origin);

/// The inverse; empty if somebody else wrote the comment.
[[nodiscard]] std::optional<RecordedOrigin> parseOrigin(std::string_view comment);

/// What a recording says at its end about how it was received, so that a report on it is the one that was
/// made then. In a note of the recording, in words: "Posewire: received for 12.031000000 s, the last
/// 1.700000000 s without a packet; receive buffer 4194304 bytes".
struct Reception {
    Duration time{};
    Duration afterLast{};                 ///< the part of it after the last packet
    std::uint64_t receiveBufferBytes = 0; ///< 0 without a socket

    friend bool operator==(const Reception&, const Reception&) = default;
};

[[nodiscard]] std::string receptionText(const Reception& reception);

/// The inverse; empty if somebody else wrote the note, or it tells of more than a year.
[[nodiscard]] std::optional<Reception> parseReception(std::string_view note);
/// The last one of the notes of a recording.
[[nodiscard]] std::optional<Reception> receptionIn(std::span<const std::string_view> notes);

/// What an operator said of a packet while it was recorded. In a note of the recording, in words: "Mark on
/// packet 12 at 03:28:07.123: left hand jumps".
struct RecordedMark {
    std::uint64_t packet = 0; ///< counts from 0 in the file
    std::string time;         ///< of the day, for people; may be empty
    std::string comment;      ///< UTF-8; may be empty

    friend bool operator==(const RecordedMark&, const RecordedMark&) = default;
};

[[nodiscard]] std::string markText(const RecordedMark& mark);

/// The inverse; empty if the note says something else.
[[nodiscard]] std::optional<RecordedMark> parseMark(std::string_view note);

/// The comment of a packet that was marked, which may have a comment of its own: "Mark: left hand jumps".
[[nodiscard]] std::string packetMarkText(const std::string& comment);
/// The inverse; nothing if the packet was not marked.
[[nodiscard]] std::optional<std::string> parsePacketMark(std::string_view comment);

/// Empty fields are left out.
struct RecordingInfo {
    std::string hardware;
    std::string system;
    std::string application;
};

/// Writes packets as pcapng (draft-ietf-opsawg-pcapng): a section header, one interface with nanosecond
/// stamps, an enhanced packet block for each packet, interface statistics. Each packet gets IP and
/// UDP headers that are made up from its sender; what they cannot hold (TCP, a file name, flags) is in a
/// comment, see RecordedOrigin; packets from before 1970 are of a second interface, whose stamps begin
/// earlier. readFile() gives back the same packets: bytes, stamps, senders, kernel drops, flags, comments.
/// `sink` must outlive the writer. After a failure nothing more is written.
class PcapngWriter {
public:
    using Result = tl::expected<void, FileError>;

    explicit PcapngWriter(ByteSink& sink) : m_sink(sink) {}

    /// First of all.
    Result begin(const RecordingInfo& info);

    /// `setBy`: what the wall clock is ahead of the packet's stamp. `comments`: UTF-8; what is longer than
    /// 65,000 bytes is cut.
    Result add(const Packet& packet, const SenderInfo& sender, std::span<const std::string> comments = {},
               Duration setBy = {});

    /// Last of all, and whenever the notes should outlast what may happen before: the newest statistics of a
    /// file count. `notes` are about all of it so far: UTF-8, cut as comments are.
    Result addStatistics(std::span<const std::string> notes = {});

    [[nodiscard]] std::uint64_t packetOffset() const { return m_packetOffset; }
    [[nodiscard]] std::uint64_t packets() const { return m_packets; }
    [[nodiscard]] std::uint64_t bytes() const { return m_bytes; } ///< of the file so far

private:
    Result beginInterface(std::int64_t offsetSeconds);
    Result write();

    ByteSink& m_sink;
    std::vector<std::byte> m_block;
    std::vector<std::byte> m_frame;
    std::uint64_t m_packets = 0;
    std::uint64_t m_bytes = 0;
    std::uint64_t m_packetOffset = 0;
    std::uint64_t m_kernelDrops = 0;
    std::optional<Duration> m_setBefore; ///< what the clock was set by when the recording began
    WallTime m_firstTime = WallTime::max();
    WallTime m_lastTime{};
    bool m_hasEarlyInterface = false;
};

} // namespace posewire::log
