// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/log_reader.h"
#include "core/log/packet_log.h"
#include "core/log/time.h"
#include "core/model/incidents/incident_follower.h"
#include "core/model/message.h"
#include "core/model/session/content.h"
#include "core/model/session/counting.h"
#include "core/model/session/roll.h"

#include <cstddef>
#include <cstdint>

namespace posewire::model {

/// Follows a PacketLog: who sends, which streams there are, what is missing of them and why, what happened.
/// Every packet is observed once, in the order of the log, and passes one stage after the other: Roll,
/// Counting, Content. Its body is decoded once, since malformed datagrams and notices are counted, and all
/// stages read that value. Only counts are kept, and what can be read again from the log. One thread.
class Ingest {
public:
    /// A stream's newest datagram is kept decoded unless it is larger: the largest legal one has less than
    /// 3,000 bytes.
    static constexpr std::size_t kMostNewestBytes = 4096;

    explicit Ingest(const log::PacketLog& log, std::uint64_t from = 0)
        : m_log(log),
          m_follower(log::LogFollower::fromOldest(log, from)),
          m_counting(log.scratch(), m_roll, m_incidents),
          m_roll(log.senders(), m_counting),
          m_content(m_roll, m_incidents) {}

    /// Reads at most `most` new packets; true if there were any.
    bool follow(log::Stamp now, std::size_t most);
    void setHeldUp(bool isHeldUp) { m_isHeldUp = isHeldUp; }
    /// The same while a file is read: however new its packets are, silence after them is no silence.
    bool followFile(log::Stamp now, std::size_t most);
    /// Nothing more is read: what is not there by now is lost.
    void settle() { m_counting.settle(); }
    void setEdges(const TimeRange& range) { m_roll.setEdges(range); }
    /// Makes counts exact at one of the edges by counting packets [first, end) again: those in `read` and in
    /// some seconds around it. See CountHistory::cutAt().
    void cutAt(log::Stamp edge, const TimeRange& read, std::uint64_t first, std::uint64_t end);
    /// All that was read is a file that has ended: no sender in it is expected to send on after the time that
    /// went by after its last packet while it was recorded.
    void endFile();

    void setKernel(const log::KernelCounters& counters) { m_content.setKernel(counters); }
    void setUsual(const SenderOverride& usual) { m_roll.setUsual(usual); }
    void setOverride(log::SenderId sender, const SenderOverride& overrides);
    /// See Roll.
    bool forget(log::SenderId sender) { return m_roll.forget(sender, m_now); }

    [[nodiscard]] const Roll& roll() const { return m_roll; }
    [[nodiscard]] const Counting& counting() const { return m_counting; }
    [[nodiscard]] const Content& content() const { return m_content; }
    [[nodiscard]] const IncidentFollower& incidents() const { return m_incidents; }
    /// To report what no packet tells, and to set limits.
    [[nodiscard]] IncidentFollower& incidents() { return m_incidents; }
    [[nodiscard]] const log::PacketLog& log() const { return m_log; }
    /// Packets as of the last follow().
    [[nodiscard]] log::LogReader& reader() { return m_follower.reader(); }

    [[nodiscard]] bool isFile() const { return m_isFile; }
    [[nodiscard]] bool isBeingRead() const { return m_isFile && !m_isRead; }
    [[nodiscard]] log::Stamp now() const { return m_now; }
    /// Of a file its end, however long ago that was.
    [[nodiscard]] log::Stamp knownUntil() const { return m_isFile ? m_observed : m_now; }
    /// See SessionView.
    [[nodiscard]] log::Duration behind() const;
    [[nodiscard]] std::uint64_t begin() const { return m_begin; }
    [[nodiscard]] std::uint64_t end() const { return m_follower.position(); }
    [[nodiscard]] log::Stamp firstStamp() const { return m_firstStamp; }
    /// Packets that the log had dropped before they were looked at.
    [[nodiscard]] std::uint64_t overtaken() const { return m_follower.overtaken() - m_dropRecordsUnseen; }
    /// Datagrams that this computer dropped among those: of no sender that is known.
    [[nodiscard]] std::uint64_t dropsUnseen() const { return m_dropsUnseen; }
    /// Datagrams of streams and characters beyond the limits: they are in the log, and nowhere else.
    [[nodiscard]] std::uint64_t unfollowed() const { return m_unfollowed; }

private:
    /// Returns the number of packets taken.
    std::size_t takeNew(log::Stamp now, std::size_t most);
    /// Silence after the newest packet, at moments that follow from its stamp alone: what is found, and in
    /// which order, is the same however often it is looked at.
    void passTime(log::Stamp until);
    void take(const log::Packet& packet);
    void decode(Observed& seen);
    bool enter(Observed& seen);

    const log::PacketLog& m_log;
    log::LogFollower m_follower;
    std::uint64_t m_begin = 0;
    std::uint64_t m_dropsUnseen = 0;
    std::uint64_t m_dropRecordsUnseen = 0;
    std::uint64_t m_unfollowed = 0;
    log::Stamp m_now{};
    log::Stamp m_firstStamp{};
    log::Stamp m_observed{}; ///< of the newest packet
    log::Stamp m_moment{};   ///< at which silence after it is looked at next
    bool m_isBegun = false;  ///< the first packet has come
    bool m_isFile = false;
    bool m_isRead = false;   ///< to its end
    bool m_isHeldUp = false; ///< only packets tell what time it is
    bool m_isLive = false;   ///< packets have come as they were stamped
    Message m_unplaced;      ///< a datagram is decoded into it while its stream is not known
    IncidentFollower m_incidents;
    Counting m_counting;
    Roll m_roll; ///< tells the counting
    Content m_content;
};

} // namespace posewire::model
