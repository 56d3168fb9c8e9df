// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"
#include "core/model/accounting/stream.h"
#include "core/model/accounting/stream_counts.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace posewire::model {

/// Samples of a stream that did not come between two that did, and whose loss that was.
struct Gap {
    /// What the cause rests on.
    enum class Evidence : std::uint8_t {
        None,        ///< nothing speaks for anybody
        Dropped,     ///< this computer dropped datagrams of the socket meanwhile
        Overtaken,   ///< this computer did not look at packets of the log in time
        Damaged,     ///< one of the samples came truncated
        Partial,     ///< of a sample next to it only a part came
        OtherStream, ///< other streams of the sender brought one of the samples
        Reliable,    ///< TCP loses nothing
        Paused,      ///< all streams of the sender paused together, and the time code moved with the pause
    };

    log::StreamKey stream;
    std::uint32_t fromSample = 0; ///< the samples around it, which came
    std::uint32_t toSample = 0;
    log::Stamp fromStamp{};
    log::Stamp toStamp{};
    std::uint64_t fromPacket = 0;
    std::uint64_t toPacket = 0;
    std::uint32_t lost = 0; ///< what still is; 0 where all came late or nothing was expected
    LossCause cause = LossCause::Unknown;
    Evidence evidence = Evidence::None;
    bool isJudged = false;           ///< else late arrivals are still waited for
    std::uint32_t timeCodeMoved = 0; ///< ms
    std::uint64_t figure = 0;        ///< of the evidence: datagrams, a sample, ms
    std::uint8_t otherType = 0;      ///< of the evidence OtherStream

    /// One sentence with figures.
    [[nodiscard]] std::string evidenceText() const;
};

/// Finds whose loss each gap and each incomplete sample was, from the log alone: the answer is the same in
/// whatever portions it is read. Judged some time of the log later, since late arrivals may still fill it,
/// and corrected where they come even later.
class Attribution {
public:
    static constexpr log::Duration kPatience = std::chrono::milliseconds(150);
    static constexpr std::size_t kMostGaps = 65'536;
    /// What memoryBytes() can become, about.
    static constexpr std::size_t kMostBytes = std::size_t{32} << 20;
    /// A shorter silence of a sender is no pause.
    static constexpr log::Duration kPause = std::chrono::milliseconds(250);

    /// The stream outlives this, or is retired with its sender before it goes.
    void addStream(Stream& stream, const log::SenderInfo& info);
    /// What is yet to be judged of the sender's streams stays as it is.
    void retire(log::SenderId sender);

    /// Each packet, before its content: notes drops and judges what is due. Returns the gaps that were
    /// judged, valid until the next call.
    std::span<const Gap> takePacket(const log::Packet& packet, std::uint16_t localPort);
    /// Packets just below one were passed over: whatever they were of is missing for that.
    void takeOvertaken(std::uint64_t packet, std::uint64_t count);
    /// Each datagram of a type that counts samples.
    void takeSampled(log::SenderId sender, log::Stamp stamp);
    /// One that has a header and cannot be decoded.
    void takeMalformed(const log::Packet& packet, const wire::Header& header);
    /// What waits of the stream is judged before its accounting forgets it.
    static void expectJudgement(Stream& stream);
    /// A verdict of the stream's accounting.
    void takeVerdict(Stream& stream, const Verdict& verdict);

    /// The newest ones, oldest first.
    [[nodiscard]] const std::deque<Gap>& gaps() const { return m_gaps; }
    [[nodiscard]] std::size_t memoryBytes() const;
    /// The gap that a packet ended; null where it ended none, or one that is forgotten.
    [[nodiscard]] const Gap* endedBy(std::uint64_t packet) const;

private:
    struct Sender {
        std::vector<const Stream*> streams; ///< those that count samples
        log::Transport transport = log::Transport::Udp;
        std::uint16_t localPort = 0;
        log::Stamp lastStamp{};
        std::deque<TimeRange> silences;
    };
    /// A sample of which only a part has come yet.
    struct Partial {
        Stream* stream = nullptr; ///< null where it was judged, or retired
        std::uint32_t sample = 0;
        log::Stamp stamp{};
        std::uint64_t packet = 0;     ///< the first that came of it
        std::uint64_t datagrams = 0;  ///< of the stream until then
        std::uint64_t nextPacket = 0; ///< the first of the next sample of the stream; 0 until that comes
        LossCause cause = LossCause::Unknown;
    };
    struct Drop {
        std::uint64_t packet = 0; ///< the first after them
        std::uint64_t count = 0;
        std::optional<std::uint16_t> localPort{}; ///< nothing: of the log, not looked at in time
    };
    /// What this computer lost between two packets.
    struct LostHere {
        std::uint64_t dropped = 0;
        std::uint64_t overtaken = 0;
    };
    struct Damage {
        log::StreamKey stream;
        std::uint32_t sample = 0;
        std::uint64_t packet = 0;
    };
    /// A gap and the stream it is of.
    struct Due {
        std::uint64_t gap = 0;
        Stream* stream = nullptr;    ///< null where it was judged, or retired
        std::uint64_t datagrams = 0; ///< of the stream until then
    };

    void judgeEarly(Stream& stream, std::uint64_t packet);
    void judge(Due& due, std::vector<Gap>& judged);
    void judge(Partial& partial, std::uint64_t packet);
    void takePartial(Stream& stream, const Verdict& verdict);
    void complete(Stream& stream, std::uint32_t sample);
    [[nodiscard]] LossCause causeOfPartial(const log::StreamKey& stream, std::uint64_t fromPacket,
                                           std::uint64_t toPacket) const;
    void recount(Gap& gap, Stream& stream);
    void recount(Stream& stream, std::optional<std::uint32_t> around);
    void findCause(Gap& gap, const Stream& stream) const;
    /// Datagrams of a port behind one packet, up to another.
    [[nodiscard]] LostHere lostHere(std::uint64_t fromPacket, std::uint64_t toPacket,
                                    std::uint16_t localPort) const;
    [[nodiscard]] const Damage* damageWithin(const Gap& gap) const;
    [[nodiscard]] bool hasPaused(const Gap& gap, const Sender& sender) const;
    [[nodiscard]] Gap* find(std::uint64_t number) {
        return number < m_firstGap ? nullptr : &m_gaps[number - m_firstGap];
    }

    std::unordered_map<log::SenderId, Sender> m_senders;
    std::deque<Gap> m_gaps;
    std::uint64_t m_firstGap = 0;
    std::deque<Due> m_due; ///< yet to be judged, oldest first
    std::vector<Gap> m_judged;
    std::vector<Gap> m_judgedEarly; ///< since the last packet
    std::deque<Partial> m_partials; ///< yet to be judged, oldest first
    std::uint64_t m_firstPartial = 0;
    std::deque<Partial> m_judgedPartials; ///< the newest ones
    std::deque<Drop> m_drops;
    std::deque<Damage> m_damages;
};

} // namespace posewire::model
