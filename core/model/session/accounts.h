// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/kernel_counters.h"
#include "core/log/stream_index.h"
#include "core/model/accounting/attribution.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/accounting/stream_counts.h"
#include "core/model/session/roster.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace posewire::model {

/// Characters on no list, because a corrupt header may have invented them.
struct Unproven {
    std::size_t characters = 0;
    std::uint64_t datagrams = 0;
};

class Accounts {
public:
    /// The roster is of the same moment, and outlives this.
    Accounts(const Moment& moment, const Roster& roster) : m_moment(moment), m_roster(roster) {}

    /// Sums over the senders that were retired: their rows are gone.
    [[nodiscard]] const RetiredTotals& retired() const;
    /// Sums over all senders, the retired ones included.
    [[nodiscard]] SenderTotals allSenders() const;
    /// Of each sender that is listed; of a range those of the packets in it that are kept, which are all
    /// read.
    [[nodiscard]] std::map<log::SenderId, SenderTotals>
    eachSender(const std::optional<TimeRange>& range) const;
    /// See Ingest.
    [[nodiscard]] std::uint64_t unfollowed() const;
    [[nodiscard]] std::uint64_t overtaken() const;
    [[nodiscard]] std::uint64_t dropsUnseen() const;
    [[nodiscard]] const log::KernelCounters& kernel() const;
    /// Of all characters that may be the invention of corrupt headers.
    [[nodiscard]] Unproven unproven() const;

    /// How often the sender of a character was restarted: came from another port, or set its counters back.
    [[nodiscard]] std::uint64_t restartsOf(const CharacterKey& key) const;
    /// Senders of which others have taken over every character.
    [[nodiscard]] std::vector<const Sender*> endedSenders() const;
    /// Whether Session::forget would take it out of the lists.
    [[nodiscard]] bool isForgettable(log::SenderId sender) const;

    /// Sums over all streams of a character in a range of time, without what makes no sense of several.
    [[nodiscard]] StreamCounts countsOf(const CharacterKey& key, const TimeRange& range) const;
    /// Every gap in a stream, judged or not, with whose loss it was.
    [[nodiscard]] const Attribution& attribution() const;

    /// One for every packet from begin() to end() of the session.
    [[nodiscard]] const PacketDigests& digests() const;
    /// The end of those that are final; of what comes after, gaps and restarts may yet turn out otherwise.
    [[nodiscard]] std::uint64_t settledEnd() const;

private:
    Moment m_moment;
    const Roster& m_roster;
};

} // namespace posewire::model
