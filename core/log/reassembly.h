// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"
#include "core/log/ip_packet.h"
#include "core/log/recording_file.h"
#include "core/log/tcp_framer.h"

#include <deque>
#include <list>
#include <map>
#include <set>

/// From captured frames to the datagrams that a listener would have received.
namespace posewire::log {

/// Puts IP fragments together (RFC 791, RFC 8200 section 4.5), in whatever order and however often they come.
class IpFragments {
public:
    using Visitor = std::function<void(const IpPacket&)>;

    /// At most this many packets may be incomplete at a time; the oldest is given up first.
    static constexpr std::size_t kMostPending = 32;
    /// Whose fragments have not gone on for longer is given up: its identification may soon belong to another
    /// packet, within seconds at the rates of many performers (RFC 4963).
    static constexpr Duration kLongestWait = std::chrono::seconds(1);

    /// The visitor gets a packet when it is complete, or given up: then its beginning, if that was there.
    explicit IpFragments(Visitor visit) : m_visit(std::move(visit)) {}

    void add(const IpPacket& fragment);

    /// Gives up what is incomplete.
    void finish();

private:
    struct Pending {
        IpPacket packet; ///< the first fragment's headers; its bytes are gone
        std::map<std::uint32_t, std::vector<std::byte>> pieces; ///< by offset
        std::size_t kept = 0;                                   ///< bytes of all pieces
        std::optional<std::uint32_t> size;                      ///< known from the last fragment
    };

    void giveUpOld(std::optional<WallTime> now);
    Pending& pendingOf(const IpPacket& fragment);
    static bool isWhole(const Pending& pending);
    void give(const Pending& pending) const;

    Visitor m_visit;
    std::list<Pending> m_pending; ///< oldest first
};

/// One direction of a captured TCP connection: puts segments in order, leaves out what came before, cuts the
/// bytes into datagrams. What the capture has missed is waited for and then passed over: the datagram that it
/// was part of comes out cut off, and the bytes up to the next one as skipped.
class TcpStream {
public:
    static constexpr std::size_t kMostWaiting = std::size_t{256} << 10;
    static constexpr Duration kLongestWait = std::chrono::seconds(1);

    /// Records carry the offset in the file of their first byte and the time of the frame that completed
    /// them. `visit` must outlive the stream.
    TcpStream(SenderInfo sender, std::uint32_t firstSequence, const FileVisitor& visit)
        : m_visit(visit), m_sender(std::move(sender)), m_expected(firstSequence) {}

    void add(const TcpSegment& segment);

    /// The connection has ended, or starts again with another sequence number.
    void finish();
    void restart(std::uint32_t firstSequence);

    /// The sequence number that is expected next.
    [[nodiscard]] std::uint32_t expected() const { return m_expected; }

private:
    struct Waiting {
        std::vector<std::byte> bytes;
        std::uint64_t fileOffset = 0;
        std::optional<WallTime> time;
        bool isInOnePiece = true;
    };
    struct Place {
        std::uint64_t position = 0; ///< in what the framer has been given
        std::uint64_t fileOffset = 0;
        bool isInOnePiece = true;
    };

    /// Hands on what is new of a segment that begins at the expected byte or before it.
    void append(const TcpSegment& segment);
    void keepWaiting(TcpSegment segment, std::uint64_t position);
    void appendWaiting(std::optional<WallTime> time);
    void passOver();
    void endPart();
    [[nodiscard]] bool hasWaitedTooLong(const TcpSegment& segment) const;
    void visit(const TcpFramer::Piece& piece);

    const FileVisitor& m_visit;
    SenderInfo m_sender;
    TcpFramer m_framer;
    std::uint32_t m_expected;
    std::uint64_t m_expectedPosition = 0;       ///< the same, without wrapping around
    std::map<std::uint64_t, Waiting> m_waiting; ///< by position
    std::size_t m_waitingSize = 0;
    std::deque<Place> m_places; ///< where in the file the bytes are that the framer may still give out
    std::uint64_t m_given = 0;
    std::optional<WallTime> m_time; ///< of the bytes given last
};

/// Finds what a listener for MXTP would have received in captured frames: one datagram to a UDP packet, which
/// IP may have sent in fragments, or back to back on TCP. A UDP packet counts if it begins with "MXTP"; any
/// other one is foreign if it goes to port 9763 or to one that has carried MXTP, and else none of ours. A TCP
/// stream counts if it goes to port 9763 or one of its segments begins a datagram. Memory is bounded: by
/// IpFragments, and by kMostStreams.
class Reassembly {
public:
    /// At most this many TCP streams are followed at a time; the one that was silent longest is ended first.
    static constexpr std::size_t kMostStreams = 64;

    explicit Reassembly(const FileVisitor& visit) : m_visit(visit) {}

    void add(const CapturedFrame& frame);
    /// A frame of a recording: a UDP packet that carries whatever was received.
    void addRecorded(const CapturedFrame& frame);
    /// The capture has ended: what is incomplete comes out.
    void finish();

    /// The packets that were added.
    [[nodiscard]] const CaptureContents& contents() const { return m_contents; }

private:
    static constexpr std::uint16_t kDefaultPort = 9763;
    /// One direction of a connection.
    struct Direction {
        IpAddress sender;
        IpAddress target;
        std::uint16_t sourcePort = 0;
        std::uint16_t targetPort = 0;
        friend auto operator<=>(const Direction&, const Direction&) = default;
    };
    struct Followed {
        TcpStream stream;
        std::uint64_t lastUse = 0;
    };

    void addPacket(const IpPacket& packet);
    void addUdp(const IpPacket& packet);
    void addTcp(const IpPacket& packet);
    void endOldest();

    const FileVisitor& m_visit;
    IpFragments m_fragments{[this](const IpPacket& whole) { addPacket(whole); }};
    std::map<Direction, Followed> m_streams;
    std::set<std::uint16_t> m_ports{kDefaultPort}; ///< UDP ports where other datagrams are foreign
    std::uint64_t m_uses = 0;
    CaptureContents m_contents;
};

} // namespace posewire::log
