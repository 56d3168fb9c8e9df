// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/raw_file.h"
#include "core/log/tcp_framer.h"
#include "core/log/time.h"

#include <deque>
#include <map>

namespace posewire::log {

/// What one captured frame adds to one direction of a TCP connection.
struct TcpSegment {
    std::uint32_t sequence = 0; ///< of the first byte of `bytes`
    std::span<const std::byte> bytes;
    std::uint64_t fileOffset = 0; ///< of the first byte of `bytes`
    std::optional<Stamp> stamp;
};

/// One direction of a captured TCP connection: puts segments in order, leaves out what came before, cuts the
/// bytes into datagrams. What the capture has missed is waited for and then passed over: the datagram that it
/// was part of comes out cut off, and the bytes up to the next one as skipped.
class TcpStream {
public:
    /// How much may wait for a missing segment, and how long.
    static constexpr std::size_t kMostWaiting = std::size_t{256} << 10;
    static constexpr Duration kLongestWait = std::chrono::seconds(1);

    TcpStream(SenderInfo sender, std::uint32_t firstSequence);

    /// Records carry the offset in the file of their first byte and the stamp of the frame that completed
    /// them.
    void add(const TcpSegment& segment, const FileVisitor& visit);

    /// The connection has ended, or starts again with another sequence number.
    void finish(const FileVisitor& visit);
    void restart(std::uint32_t firstSequence, const FileVisitor& visit);

    /// The sequence number that is expected next.
    [[nodiscard]] std::uint32_t expected() const { return m_expected; }

private:
    struct Waiting {
        std::vector<std::byte> bytes;
        std::uint64_t fileOffset = 0;
        std::optional<Stamp> stamp;
    };
    struct Place {
        std::uint64_t position = 0; ///< in what the framer has been given
        std::uint64_t fileOffset = 0;
    };

    void append(const TcpSegment& segment, const FileVisitor& visit);
    void appendWaiting(std::optional<Stamp> stamp, const FileVisitor& visit);
    void passOver(const FileVisitor& visit);
    [[nodiscard]] bool hasWaitedTooLong(const TcpSegment& segment) const;
    [[nodiscard]] FileRecord recordOf(const TcpFramer::Piece& piece, std::optional<Stamp> stamp);

    SenderInfo m_sender;
    TcpFramer m_framer;
    std::uint32_t m_expected;
    std::uint64_t m_expectedPosition = 0;       ///< the same, without wrapping around
    std::map<std::uint64_t, Waiting> m_waiting; ///< by position
    std::size_t m_waitingSize = 0;
    std::deque<Place> m_places; ///< where in the file the bytes are that the framer may still give out
    std::uint64_t m_given = 0;
    std::optional<Stamp> m_lastStamp;
};

} // namespace posewire::log
