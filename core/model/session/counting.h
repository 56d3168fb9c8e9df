// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/stream_index.h"
#include "core/model/accounting/attribution.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/accounting/stream_accounting.h"
#include "core/model/session/roll.h"

#include <cstdint>
#include <memory>

namespace posewire::model {

class IncidentFollower;

/// The second stage: counts and indexes what came, finds what is missing and whose loss it was, and tells the
/// incidents.
class Counting final : public RollListener {
public:
    /// What was received this long ago is in the log.
    static constexpr log::Duration kUnderWay = std::chrono::milliseconds(50);

    /// The roll and the incidents outlive this; neither is looked at here.
    Counting(const std::shared_ptr<log::Scratch>& scratch, Roll& roll, IncidentFollower& incidents);

    /// Each packet of a known sender, before its content.
    void takePacket(const Observed& seen);
    /// One that cannot be decoded.
    void takeFaulty(const Observed& seen);
    /// Adds a datagram to the index without counting it.
    void index(const Observed& seen);
    /// One that was decoded, of a stream that is followed.
    void takeDatagram(Observed& seen);
    /// Each packet, last.
    void close(const Observed& seen);
    /// Packets just below one were passed over, because the log had dropped them: what was lost with them is
    /// this computer's loss.
    void takeOvertaken(std::uint64_t packet, std::uint64_t count, log::Stamp stamp);
    /// Datagrams that this computer dropped according to packets that were passed over, so of unknown ports.
    void takeDropsUnseen(std::uint64_t count, const log::Packet& next);
    /// Time passes without packets.
    void advance(log::Stamp stamp);
    /// Nothing more comes: what is not there by now is lost.
    void settle();
    void dropBefore(std::uint64_t packet);

    [[nodiscard]] const Attribution& attribution() const { return m_attribution; }
    /// One for each packet.
    [[nodiscard]] const PacketDigests& digests() const { return m_digests; }
    [[nodiscard]] const log::StreamIndex& index() const { return m_index; }

    void began(Stream& stream, const Sender& sender) override;
    void tookOver(const CharacterKey& before, const CharacterKey& after, log::Stamp since) override;
    void isAwaited(const CharacterKey& key) override;
    void goes(const Sender& sender) override;
    void haveGone() override { fitDepth(); }

private:
    void passOverDropped(const Observed& seen);
    void passOver(std::uint64_t count);
    void takeVerdict(Stream& stream, const Verdict& verdict, bool isConfirmed);
    void amendGaps();
    void fitDepth();

    Roll& m_roll;
    IncidentFollower& m_incidents;
    Attribution m_attribution; ///< tells the incidents of losses
    log::StreamIndex m_index;
    PacketDigests m_digests;
    AccountingDepth m_depth;
    log::Stamp m_observed{}; ///< of the newest packet
};

} // namespace posewire::model
