// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/log_reader.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace posewire::log {

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

    /// The next packet below `end` that there was at the last refresh(), valid until the next one; nothing
    /// where all were taken.
    std::optional<Packet> next(std::uint64_t end = UINT64_MAX);

    /// Passes over the packets below one.
    void skipTo(std::uint64_t number);

    /// How many were passed over since this was last asked: just before the packet taken last, where it is
    /// asked after each.
    std::uint64_t takeOvertaken() { return std::exchange(m_overtakenSince, 0); }

    /// What was dropped where packets were passed over, since this was last asked, and how many of those were
    /// only records of that. Known once the next packet is taken.
    DropSums takeUnseen() { return std::exchange(m_unseen, {}); }

    /// What was dropped before the packet that was taken last, seen or not; nothing where nobody knows.
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
    std::optional<DropSums> m_drops; ///< before the next packet, seen or not; nothing where nobody knows
    std::optional<DropSums> m_dropsBeforeTaken;
    bool m_mayHaveDrops = false; ///< packets were passed over since the last one that was taken
    DropSums m_unseen;
};

} // namespace posewire::log
