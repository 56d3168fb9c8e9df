// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/model/accounting/stream.h"
#include "core/words/fact.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

namespace posewire::model {

/// Samples of a stream that did not come between two that did, and whose loss that was.
struct Gap {
    enum class Evidence : std::uint8_t {
        None,         ///< nothing speaks for anybody
        Dropped,      ///< this computer dropped datagrams of the socket meanwhile
        NotListening, ///< the input of the port was closed meanwhile
        Overtaken,    ///< this computer did not look at packets of the log in time
        Damaged,      ///< one of the samples came truncated
        Partial,      ///< of a sample next to it only a part came
        OtherStream,  ///< other streams of the sender brought one of the samples
        Reliable,     ///< TCP loses nothing
        CutOff,       ///< a silence of all streams began or ended within a sample
        Paused,       ///< all streams of the sender paused together, and the time code moved with the pause
    };

    log::StreamKey stream;
    std::uint32_t fromSample = 0; ///< the samples around it, which came
    std::uint32_t toSample = 0;
    log::Stamp fromStamp{};
    log::Stamp toStamp{};
    std::uint64_t fromPacket = 0;
    std::uint64_t toPacket = 0;
    std::uint32_t lost = 0; ///< what still is; 0 if all came late or nothing was expected
    LossCause cause = LossCause::Unknown;
    Evidence evidence = Evidence::None;
    bool isJudged = false;           ///< else late arrivals are still waited for
    std::uint32_t timeCodeMoved = 0; ///< ms
    std::uint64_t figure = 0;        ///< of the evidence: datagrams, a sample, ms
    std::uint64_t incident = 0;      ///< that its loss is told in; 0 for none
    std::uint8_t otherType = 0;      ///< of the evidence OtherStream or CutOff
    Stream* waiting = nullptr;       ///< its stream, until it is judged or retired
    std::uint64_t datagrams = 0;     ///< of the stream when it ended

    [[nodiscard]] bool isAround(std::uint32_t sample) const;
    [[nodiscard]] words::Fact evidenceFact() const;
};

/// What the log shows of losses: drops of this computer, damaged datagrams, silences of senders, and what
/// other streams brought meanwhile.
class LossEvidence {
public:
    /// The stream outlives this, or is retired with its sender before it goes.
    void addStream(const Stream& stream, const log::SenderInfo& info);
    void retire(log::SenderId sender) { m_senders.erase(sender); }
    void takePacket(const log::Packet& packet, std::uint16_t localPort);
    void takeOvertaken(std::uint64_t packet, std::uint64_t count);
    void takeSampled(log::SenderId sender, log::Stamp stamp);
    void takeMalformed(const log::Packet& packet, const wire::Header& header);

    /// Sets cause and evidence of a gap, one of `gaps`.
    void findCause(Gap& gap, const Stream& stream, const std::deque<Gap>& gaps) const;
    /// Whose loss the rest of a sample or message is, of which some came from a packet on.
    [[nodiscard]] LossCause causeOfPartial(const log::StreamKey& stream, std::uint64_t fromPacket,
                                           std::uint64_t toPacket) const;
    [[nodiscard]] std::size_t memoryBytes() const;

private:
    struct Sender {
        std::vector<const Stream*> streams; ///< those that count samples
        log::Transport transport = log::Transport::Udp;
        std::uint16_t localPort = 0;
        log::Stamp lastStamp{};
        std::deque<TimeRange> silences;
    };
    struct Drop {
        std::uint64_t packet = 0; ///< the first after them
        std::uint64_t count = 0;
        std::optional<std::uint16_t> localPort{}; ///< nothing: of the log, not looked at in time
        bool isClosed = false; ///< the port was not listened to; nobody knows how many there were
    };
    struct LostHere {
        std::uint64_t dropped = 0;
        std::uint64_t overtaken = 0;
        bool isClosed = false; ///< what came meanwhile had nobody to take it

        [[nodiscard]] bool isAny() const { return dropped + overtaken != 0 || isClosed; }
    };
    struct Damage {
        log::StreamKey stream;
        std::uint32_t sample = 0;
        std::uint64_t packet = 0;
    };
    /// Datagrams of a port behind one packet, up to another.
    [[nodiscard]] LostHere lostHere(std::uint64_t fromPacket, std::uint64_t toPacket,
                                    std::uint16_t localPort) const;
    [[nodiscard]] const Damage* damageWithin(const Gap& gap) const;

    std::unordered_map<log::SenderId, Sender> m_senders;
    std::deque<Drop> m_drops;
    std::deque<Damage> m_damages;
};

/// Adds a value; the oldest goes if there are too many.
template <class Value>
void keepNewest(std::deque<Value>& values, const Value& value, std::size_t most) {
    values.push_back(value);
    if (values.size() > most) {
        values.pop_front();
    }
}

} // namespace posewire::model
