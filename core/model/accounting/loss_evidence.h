// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/model/accounting/stream.h"
#include "core/words/fact.h"

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace posewire::model {

/// Samples of a stream that did not come between two that did, and whose loss each was.
struct Gap {
    enum class Evidence : std::uint8_t {
        None,         ///< nothing speaks for anybody
        Dropped,      ///< this computer dropped datagrams of the socket meanwhile
        NotListening, ///< the input of the port was closed meanwhile
        Overtaken,    ///< this computer did not look at packets of the log in time
        OnWay,        ///< a probe had datagrams that did not come here
        Damaged,      ///< one of the samples came truncated
        OtherStream,  ///< other streams of the sender brought one of the samples
        Reliable,     ///< TCP loses nothing
        HostsSilent,  ///< several hosts fell silent and came back together
        Paused,       ///< all streams of the sender's host were silent, and no other host was
        Uncounted,    ///< this computer does not count what it drops: nothing else can be shown
    };
    /// The samples that are lost by one cause.
    struct Share {
        std::uint32_t lost = 0;
        std::uint8_t otherType = 0; ///< of the evidence OtherStream
        Evidence evidence = Evidence::None;
        std::uint64_t figure = 0;   ///< of the evidence: datagrams, a sample, streams, hosts
        std::uint64_t incident = 0; ///< the one that reports the loss; 0 for none
    };

    log::StreamKey stream;
    std::uint32_t fromSample = 0; ///< the samples around it, which came
    std::uint32_t toSample = 0;
    log::Stamp fromStamp{};
    log::Stamp toStamp{};
    std::uint64_t fromPacket = 0;
    std::uint64_t toPacket = 0;
    std::uint32_t lost = 0;                  ///< what still is; 0 if all came late or nothing was expected
    std::array<Share, kLossCauses> shares{}; ///< by LossCause, once it is judged; together `lost`
    bool isJudged = false;                   ///< else late arrivals are still waited for

    [[nodiscard]] bool isAround(std::uint32_t sample) const;
    [[nodiscard]] const Share& of(LossCause cause) const { return shares[static_cast<std::size_t>(cause)]; }
    [[nodiscard]] Share& of(LossCause cause) { return shares[static_cast<std::size_t>(cause)]; }
    /// The one of most of its samples first; Unknown before it is judged.
    [[nodiscard]] std::vector<LossCause> causes() const;
    [[nodiscard]] LossCause mainCause() const { return causes().front(); }
    [[nodiscard]] words::Fact evidenceFact(LossCause cause) const;
};

/// What the log shows of losses: drops of this computer, damaged datagrams, silences of senders, and what
/// other streams brought meanwhile.
class LossEvidence {
public:
    /// The stream outlives this, or is retired with its sender before it goes.
    void addStream(const Stream& stream, const log::SenderInfo& info);
    void retire(log::SenderId sender);
    void takePacket(const log::Packet& packet, const log::SenderInfo& from);
    /// Packets just below one were passed over: whatever they were of is missing for that.
    void takeOvertaken(std::uint64_t packet, std::uint64_t count, log::Stamp stamp);
    /// A datagram of a type that counts samples, unless it is late. Of a sender's samples the first one of
    /// each is a sign of life: others may have been held up on their way.
    void takeSampled(log::SenderId sender, log::Stamp stamp, std::uint32_t sample);
    /// One that has a header and cannot be decoded.
    void takeMalformed(const log::Packet& packet, const wire::Header& header);

    /// Samples in a row that are lost by one cause.
    struct Run {
        LossCause cause = LossCause::Unknown;
        std::uint32_t lost = 0;
        log::Stamp from{}; ///< when the samples around them were due
        log::Stamp to{};
    };
    /// Judges each sample of a gap by all that is known of that sample. Sets its shares; valid until the next
    /// call. Of very many runs the last ones are one.
    std::span<const Run> findCauses(Gap& gap, const Stream& stream);
    /// Whose loss a sample of a judged gap was that came late.
    [[nodiscard]] LossCause causeOf(const Gap& gap, const Stream& stream, std::uint32_t sample);
    /// Whose loss the rest of a sample or message is, of which some came from a packet on.
    [[nodiscard]] LossCause causeOfPartial(const log::StreamKey& stream, std::uint64_t fromPacket,
                                           std::uint64_t toPacket) const;
    [[nodiscard]] std::size_t memoryBytes() const;

private:
    /// All streams of a host were silent.
    struct Silence {
        TimeRange when;
        log::Duration period{}; ///< of its fastest stream
    };
    struct Host {
        std::size_t senders = 0;
        std::size_t streams = 0; ///< those that count samples
        log::Stamp lastStamp{};
        std::deque<Silence> silences;
    };
    using Hosts = std::map<std::string, Host, std::less<>>;
    struct Sender {
        std::vector<const Stream*> streams; ///< those that count samples
        log::Transport transport = log::Transport::Udp;
        log::ReceivingPort port;
        bool hasUncountedDrops = false; ///< see PacketFlags::dropsUncounted
        std::uint32_t newest = 0;       ///< sample
        Hosts::iterator host;
    };
    struct Drop {
        std::uint64_t packet = 0; ///< the first after them
        log::Stamp stamp{};
        std::uint64_t count = 0;
        Gap::Evidence evidence{}; ///< Dropped; NotListening, of unknown count; Overtaken; OnWay
        log::ReceivingPort port{};
    };
    struct Damage {
        log::StreamKey stream;
        std::uint32_t sample = 0;
        std::uint64_t packet = 0;
    };
    /// Calls for what was lost behind one packet, up to another, and may be of a port: the newest first.
    template <class Visit>
    void forEachDrop(std::uint64_t fromPacket, std::uint64_t toPacket, const log::ReceivingPort& port,
                     const Visit& visit) const;
    /// A sample of the gap that is judged.
    struct Missing {
        bool isMissing = true;
        std::optional<LossCause> cause{};
        Gap::Evidence evidence = Gap::Evidence::None;
        std::uint8_t otherType = 0;
        std::uint64_t figure = 0;
    };
    /// `late`: one that has come since, to be judged as if it had not.
    void judgeSamples(const Gap& gap, const Stream& stream, std::optional<std::uint32_t> late);
    void judgeLostHere(const Gap& gap, const log::ReceivingPort& port);
    void judgeDrop(const Gap& gap, const Drop& drop, const Missing& as);
    void judgeBrought(const Gap& gap, const Sender& sender);
    void judgeSilent(const Gap& gap, const Host& host);
    void judge(std::size_t place, const Missing& as);
    void judgeRest(const Missing& as);
    [[nodiscard]] std::optional<std::size_t> placeOf(std::uint32_t sample, const Gap& gap) const;
    [[nodiscard]] log::Stamp dueAt(std::size_t place, const Gap& gap) const;
    [[nodiscard]] std::size_t hostsSilentWith(const Host& host, const Silence& silence) const;
    [[nodiscard]] log::Duration periodOf(const Host& host) const;

    Hosts m_hosts;
    std::unordered_map<log::SenderId, Sender> m_senders;
    std::deque<Drop> m_drops;
    std::deque<Damage> m_damages;
    std::uint32_t m_step = 1;         ///< of the gap that is judged
    bool m_isCounterStopped = false;  ///< its samples are farther apart than the stream's
    std::vector<Missing> m_missing{}; ///< of it: its samples in order
    bool m_isAnyJudged = false;       ///< of them
    std::vector<Run> m_runs{};        ///< of it
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
