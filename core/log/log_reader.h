// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/chunk_history.h"
#include "core/log/packet.h"
#include "core/log/past.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace posewire::log {

class PacketLog;

/// A steady look at a PacketLog: begin() and end() move only in refresh(), whatever the writer does
/// meanwhile. Each thread has a reader of its own; a reader is cheap, and must not outlive its log.
///
/// The bytes of a packet stay valid until the next refresh() or the end of the reader, also if the log
/// drops them meanwhile: what was looked at is held, chunk by chunk. A packet that was not looked at may be
/// gone. Of packets that lie in files those are held that were looked at last: PastReader::kHeld.
class LogReader {
public:
    explicit LogReader(const PacketLog& log);

    /// Moves on to what the log holds now and lets go of what was looked at. True if there are new packets.
    bool refresh();

    /// Number of the oldest packet there was at the last refresh().
    [[nodiscard]] std::uint64_t begin() const { return m_begin; }
    /// One past the newest packet there was at the last refresh().
    [[nodiscard]] std::uint64_t end() const { return m_end; }

    /// Empty if the number is outside [begin, end), the log has dropped the packet since the last
    /// refresh(), or it was dropped from memory before it was written to a file.
    [[nodiscard]] std::optional<Packet> packet(std::uint64_t number) {
        if (number - m_currentFirst < m_currentCount) {
            return view(number);
        }
        return packetElsewhere(number);
    }

    /// What this computer dropped before a packet, or before what comes next. Empty if the packet is not
    /// there any more, or nobody knows.
    [[nodiscard]] std::optional<DropSums> dropsBefore(std::uint64_t number);

    /// The packet of that number, or else the next one that is there.
    [[nodiscard]] std::optional<Packet> packetFrom(std::uint64_t number);

private:
    std::optional<Packet> packetElsewhere(std::uint64_t number);
    [[nodiscard]] bool enterChunk(std::uint64_t number);
    [[nodiscard]] std::optional<DropSums> dropsBeforeInPast(std::uint64_t number) const;

    [[nodiscard]] Packet view(std::uint64_t number) const {
        const Record& record = m_current->record(static_cast<std::size_t>(number - m_currentFirst));
        return {number,        record.stamp,
                record.sender, record.kernelDropsBefore,
                record.flags,  {record.data, record.size}};
    }

    const ChunkHistory* m_history;
    const Past* m_past;
    PastReader m_pastReader;
    std::uint64_t m_begin = 0;
    std::uint64_t m_end = 0;
    std::uint64_t m_version = 0;
    std::vector<ChunkHistory::Entry> m_entries;
    std::map<std::uint64_t, std::shared_ptr<const Chunk>> m_held; ///< what was looked at, by first packet

    const Chunk* m_current = nullptr; ///< the chunk of the last packet looked at
    std::uint64_t m_currentFirst = 0;
    std::uint64_t m_currentCount = 0;
    DropSums m_currentDrops; ///< before its first packet
};

/// Goes through a log once, packet by packet, and accounts for itself: every packet is taken, or counted as
/// one that it was too late for. One thread.
class LogFollower {
public:
    /// Begins with the oldest packet that the log still has.
    explicit LogFollower(const PacketLog& log);
    /// Begins with packet `from`: what the log has dropped from there on is passed over.
    LogFollower(const PacketLog& log, std::uint64_t from);
    /// Begins with packet `from`, or the oldest one that the log still has: nothing is passed over yet.
    [[nodiscard]] static LogFollower fromOldest(const PacketLog& log, std::uint64_t from);
    /// Begins with what comes from now on.
    [[nodiscard]] static LogFollower fromNow(const PacketLog& log);

    /// Looks at what the log holds now. Packets that it has dropped meanwhile are passed over.
    void refresh();

    /// The next packet below `end` that there was at the last refresh(), valid until the next one; empty
    /// if all were taken.
    std::optional<Packet> next(std::uint64_t end = UINT64_MAX);

    /// Passes over the packets below one.
    void skipTo(std::uint64_t number);

    /// How many were passed over since this was last asked: just before the packet taken last, if it is
    /// asked after each.
    std::uint64_t takeOvertaken() { return std::exchange(m_overtakenSince, 0); }

    /// What was dropped where packets were passed over, since this was last asked, and how many of those were
    /// only records of that. Known once the next packet is taken.
    DropSums takeUnseen() { return std::exchange(m_unseen, {}); }

    /// What was dropped before the packet that was taken last, seen or not; empty if unknown.
    [[nodiscard]] const std::optional<DropSums>& dropsBeforeTaken() const { return m_dropsBeforeTaken; }

    /// Number of the next packet.
    [[nodiscard]] std::uint64_t position() const { return m_next; }
    /// Packets that waited at the last refresh().
    [[nodiscard]] std::uint64_t lag() const { return m_reader.end() - m_next; }
    /// All that were passed over.
    [[nodiscard]] std::uint64_t overtaken() const { return m_overtaken; }

    /// For a second look at what the log holds.
    [[nodiscard]] LogReader& reader() { return m_reader; }

private:
    void beginAt(std::uint64_t number);
    void passOver(std::uint64_t count);
    void countDrops(const Packet& packet);

    LogReader m_reader;
    std::uint64_t m_next;
    std::uint64_t m_overtaken = 0;
    std::uint64_t m_overtakenSince = 0;
    std::optional<DropSums> m_drops; ///< before the next packet, seen or not; empty if unknown
    std::optional<DropSums> m_dropsBeforeTaken;
    bool m_mayHaveDrops = false; ///< packets were passed over since the last one that was taken
    DropSums m_unseen;
};

} // namespace posewire::log
