// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"
#include "core/log/timeline.h"
#include "core/model/accounting/attribution.h"
#include "core/model/accounting/events.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/accounting/thresholds.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace posewire::model {

/// Turns what the session finds in the log into events.
class EventFollower {
public:
    [[nodiscard]] const Events& events() const { return m_events; }
    /// Something that no packet tells.
    void report(const Event& event) { m_events.report(event); }
    void setThresholds(const Thresholds& thresholds) { m_watch.set(thresholds); }
    [[nodiscard]] const Thresholds& thresholds() const { return m_watch.thresholds(); }

    /// Looks whether the wall clock was set; takePacket() then tells it in its place among the packets.
    void followClock(const log::Timeline& timeline);
    /// Each packet before its content: moves the time of the log, and notes what is no datagram.
    void takePacket(const log::Packet& packet, const PacketDigest& digest);
    /// Packets just below one were passed over.
    void takeOvertaken(std::uint64_t packet, std::uint64_t count, log::Stamp stamp);
    /// Each datagram with its header.
    void takeDatagram(const log::Packet& packet, const wire::Header& header, Stream& stream);
    void takeVerdict(const log::StreamKey& stream, const Verdict& verdict);
    void takeGap(const Gap& gap);
    void takeChange(EventKind kind, const CharacterKey& key, const log::Packet& packet, std::string detail);

    /// Nothing of a sender lasts any longer, and its streams are about to go.
    void retire(log::SenderId sender);

    /// Time passes without packets: reports only who is silent.
    void advance(log::Stamp stamp);

    /// What came so far is a file, which has ended: nobody in it is expected to send on.
    void endFile();

    /// What lasts, or lasted at a time in the past, and concerns the character or its sender, worst first, a
    /// limit behind what is as bad; no notes.
    [[nodiscard]] std::vector<const Event*> troublesOf(const CharacterKey& key,
                                                       std::optional<log::Stamp> stamp) const;
    /// The worst of these.
    [[nodiscard]] Condition conditionOf(const CharacterKey& key, std::optional<log::Stamp> stamp) const;

private:
    struct Sender {
        log::Stamp lastSampled{};
        bool isDown = false;
    };
    struct Character {
        log::Stamp lastSampled{};
        std::uint64_t lastPacket = 0;
        bool isStale = false;
        log::Stamp restart{}; ///< when its counter last restarted
        // Of the newest sample, for jumps of the time code:
        std::uint32_t sample = 0;
        std::uint32_t timeCode = 0;
        log::Stamp stamp{};
    };
    /// Who sends a character in a type, and who did before; without a stamp where there is none.
    struct Claim {
        log::SenderId sender{};
        log::Stamp stamp{};
    };
    struct Claims {
        Claim newest;
        Claim before;
    };
    void tellClockSets(log::Stamp until);
    void check(log::Stamp stamp);
    void noteSampled(const log::Packet& packet, const wire::Header& header);
    void noteTimeCode(const log::StreamKey& stream, const Verdict& verdict);
    void noteClaim(const log::Packet& packet, const wire::Header& header);

    Events m_events;
    ThresholdWatch m_watch;
    std::map<log::SenderId, Sender> m_senders;
    std::map<CharacterKey, Character> m_characters;
    std::map<std::pair<std::uint8_t, std::uint8_t>, Claims> m_claims;
    std::size_t m_clockSteps = 0;              ///< of the time line that were seen
    std::vector<log::ClockStep> m_untoldSteps; ///< no packet has come since
    std::uint64_t m_lastPacket = 0;
    log::Stamp m_nextCheck{};
    log::Stamp m_nextWatch{};
};

} // namespace posewire::model
