// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"
#include "core/model/accounting/attribution.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/incidents/changes.h"
#include "core/model/incidents/incidents.h"
#include "core/model/incidents/thresholds.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace posewire::model {

/// Turns what the session finds in the log into incidents.
class IncidentFollower final : public LossSink {
public:
    /// A character from which nothing has come for as long is silent, or for three of its samples.
    static constexpr log::Duration kSilent = std::chrono::milliseconds(200);

    [[nodiscard]] const Incidents& incidents() const { return m_incidents; }
    /// Something that no packet tells.
    void report(const Occurrence& one) { m_incidents.report(one); }
    /// See Incidents::reserve.
    std::uint64_t reserve(log::SenderId sender) { return m_incidents.reserve(sender); }
    void setThresholds(const Thresholds& thresholds) { m_watch.set(thresholds); }
    [[nodiscard]] const Thresholds& thresholds() const { return m_watch.thresholds(); }

    /// Looks whether the wall clock was set; takePacket() then reports it in its place among the packets.
    void followClock(const log::Timeline& timeline) { m_clockSets.follow(timeline); }
    /// Each packet before its content: moves the time of the log, and notes what is no datagram. `header`:
    /// what could be read of it.
    void takePacket(const log::Packet& packet, const PacketDigest& digest,
                    const std::optional<wire::Header>& header);
    /// Packets just below one were passed over.
    void takeOvertaken(std::uint64_t packet, std::uint64_t count, log::Stamp stamp);
    /// This computer dropped so many where packets were passed over, just before one.
    void takeDropsUnseen(std::uint64_t count, const log::Packet& next);
    /// Who sent a datagram, and whom it is of; without a name before there is one.
    struct Whose {
        const log::SenderInfo& sender;
        std::string_view name;
    };
    /// Each datagram with its header. `isLate`: others have overtaken it.
    void takeDatagram(const log::Packet& packet, const wire::Header& header, Stream& stream,
                      const Whose& whose, bool isLate);
    void takeVerdict(Stream& stream, const Verdict& verdict);
    void takeChange(IncidentKind kind, const CharacterKey& key, const log::Packet& packet,
                    words::Fact detail);
    /// A condition that lasts for as long as there is something to be said of it, as of `one.to`.
    void takeCondition(Occurrence one);

    std::uint64_t takeLoss(const Loss& loss) override;
    void takeBack(std::uint64_t incident, const log::StreamKey& stream, std::uint64_t samples,
                  bool isAll) override;

    /// Nothing of a sender lasts any longer, and its streams are about to go.
    void retire(log::SenderId sender);
    /// Another sender sends a character now, or this one by another ID, since then: that it is silent is no
    /// fault. If it is, that is a restart.
    void supersede(const CharacterKey& key, const CharacterKey& by, log::Stamp since);
    /// Whoever took it over is forgotten: if it is silent, that is a fault again.
    void expect(const CharacterKey& key);

    /// Time passes without packets: reports only who is silent.
    void advance(log::Stamp stamp);

    /// What came so far is a file, which has ended: nobody in it is expected to send on.
    void endFile();

    /// What lasts, or lasted at a time in the past, and concerns the character or its sender, worst first, a
    /// limit behind what is as bad; no notes.
    [[nodiscard]] std::vector<const Incident*> troublesOf(const CharacterKey& key,
                                                          std::optional<log::Stamp> stamp) const;

private:
    /// From whom a character was taken over, and when.
    struct TakeOver {
        CharacterKey before{};
        log::Stamp stamp{};
    };
    struct Character {
        std::vector<Stream*> streams; ///< those that count samples
        log::Stamp lastSampled{};     ///< 0: nothing is expected
        bool isExpected = false;      ///< it is among those of which something is
        std::uint64_t lastPacket = 0;
        std::uint64_t outage = 0; ///< its number while nothing comes
        bool isLong = false;      ///< the outage
        log::Duration patience{}; ///< for which it was waited until then
        Silence lastSilence;
        log::Stamp restart{}; ///< when its counter last restarted
        TimeCodes timeCodes;
        std::optional<TakeOver> tookOver{}; ///< while it may be that both go on

        /// For how long nothing has come; 0 if nothing is expected.
        [[nodiscard]] log::Duration silenceAt(log::Stamp stamp) const {
            return lastSampled == log::Stamp() ? log::Duration() : stamp - lastSampled;
        }
    };
    void check(log::Stamp stamp);
    void checkSilence(const CharacterKey& key, Character& character, log::Stamp stamp);
    void checkEnded(log::Stamp stamp);
    void expect(const CharacterKey& key, Character& character, log::Stamp sampled);
    void fallSilent(const CharacterKey& key, Character& character, log::Stamp stamp);
    void resume(const CharacterKey& key, Character& character, log::Stamp stamp);
    void noteSampled(const log::Packet& packet, const wire::Header& header, Stream& stream);
    void checkTakenOver(const CharacterKey& key, Character& character, log::Stamp stamp);
    void excuse(const log::StreamKey& key, log::Stamp from);

    Incidents m_incidents;
    ThresholdWatch m_watch;
    Claims m_claims;
    ClockSets m_clockSets;
    std::map<log::SenderId, std::uint64_t> m_outages; ///< the newest of each sender
    std::map<CharacterKey, Character> m_characters;
    std::vector<std::pair<const CharacterKey, Character>*> m_expected; ///< those of which something is
    std::uint64_t m_lastPacket = 0;
    log::Stamp m_nextCheck{};
    log::Stamp m_nextWatch{};
};

} // namespace posewire::model
