// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"
#include "core/model/accounting/count_history.h"
#include "core/model/accounting/framing.h"
#include "core/model/accounting/probation.h"
#include "core/model/accounting/sample_ledger.h"
#include "core/model/accounting/sender_clock.h"
#include "core/model/accounting/stream_counts.h"
#include "core/wire/header.h"

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace posewire::model {

struct Verdict {
    std::uint64_t packet = 0;
    log::Stamp stamp{};
    std::uint32_t sample = 0;
    std::uint32_t timeCode = 0; ///< ms
    std::uint32_t gap = 0;      ///< samples missing just before it
    bool mayBeGap = false;      ///< the step is not certain yet; there may be some
    // Of the highest sample before it, where there is or may be a gap; the packet also of a message left
    // incomplete:
    std::uint32_t sampleBefore = 0;
    std::uint32_t timeCodeBefore = 0;
    std::uint64_t packetBefore = 0;
    log::Stamp stampBefore{};
    bool isDuplicate = false;
    bool isReordered = false;
    bool isRestart = false; ///< the first after the sender's counter restarted
    bool isStray = false;   ///< belongs to no sample: its counter is corrupt, or it is very old
    bool isFirstOfSample = false;
    bool isCompleting = false;   ///< the last datagram that its sample lacked
    bool isAfterPartial = false; ///< types 10 to 13: begins a message, and the one before was left incomplete
};

/// Counts messages of which some but not all datagrams came, among those that are sent again and again with
/// the same sample counter (types 10 to 13). Datagrams belong to one message while their indices do not
/// repeat and they come within kTogether of each other, in any order. One that comes again with the same
/// bytes in that time is a duplicate.
class MessageRounds {
public:
    static constexpr log::Duration kTogether = std::chrono::milliseconds(250);
    /// Upper bound of memoryBytes(): one part for each index.
    static constexpr std::size_t kMostBytes = 128 * 3 * sizeof(std::size_t);

    enum class Place : std::uint8_t { Begins, GoesOn, Repeats };
    /// `digest`: of its bytes.
    Place add(log::Stamp stamp, std::uint8_t datagram, bool isLast, std::size_t digest);

    /// The newest message included.
    [[nodiscard]] std::uint64_t incomplete() const { return m_incomplete; }
    [[nodiscard]] std::size_t memoryBytes() const { return m_parts.capacity() * sizeof(Part); }
    /// True if the newest message still lacks something.
    [[nodiscard]] bool isPartial() const { return m_arrived.any() && !isWhole(); }

private:
    [[nodiscard]] bool isWhole() const { return static_cast<int>(m_arrived.count()) == m_last + 1; }

    std::uint64_t m_incomplete = 0;
    // Of the newest message:
    log::Stamp m_first{};
    std::bitset<128> m_arrived; ///< by index
    int m_last = -1;            ///< index of its last datagram; -1 before that is known
    struct Part {
        log::Stamp stamp{};
        std::uint8_t datagram = 0;
        std::size_t digest = 0;
    };
    std::vector<Part> m_parts; ///< as they came
};

/// Counts exactly what came and what did not come of one stream. Follows the log: figures are of what was
/// added, never of a clock. O(1) for each datagram, no allocation once its memory, which is bounded by its
/// depth (mostBytes), has grown to what the stream needs.
///
/// Whether a step changed, the counter restarted or a datagram was only late is known only after the fact:
/// figures always reflect what is known at the time, and are right in hindsight.
class StreamAccounting {
public:
    /// Bytes at the beginning of a datagram by which two samples differ: the header and the first item.
    static constexpr std::size_t kTelling = 64;

    explicit StreamAccounting(std::uint8_t type = 2) : m_countsSamples(countsSamples(type)) {}

    /// Adds a well-formed datagram of the stream. Returns the verdicts that this made possible, in the order
    /// of arrival: usually its own, none while it is in doubt, and several when a doubt ends. Valid until the
    /// next call.
    std::span<const Verdict> add(const log::Packet& packet, const wire::Header& header);

    /// Nothing more comes: what is in doubt is decided now, as figures in hindsight have it already. Returns
    /// the verdicts, as add() does.
    std::span<const Verdict> conclude();

    /// Packets were passed over or dropped here, some of this stream perhaps: a counter that is as far ahead
    /// has lost those, and did not restart.
    void passOver(std::uint64_t packets) { m_passedOver += packets; }

    /// How much is remembered. What has been counted stays counted.
    void setDepth(const AccountingDepth& depth);
    [[nodiscard]] const AccountingDepth& depth() const { return m_depth; }
    [[nodiscard]] bool isSampled() const { return m_countsSamples; }
    /// See CountHistory.
    void setEdges(const TimeRange& range) { m_history.setEdges(range); }
    void cutAt(log::Stamp edge, StreamAccounting& exact, const TimeRange& read) {
        exact.m_ledger.addBursts(&exact.m_history);
        m_history.cutAt(edge, exact.m_history, read);
    }
    /// Beside itself.
    [[nodiscard]] std::size_t memoryBytes() const;
    /// What memoryBytes() can become: two windows of samples, a history, and what waits or was decided in
    /// doubt. In full 0.54 MB, for 4,096 streams 84 KB each.
    [[nodiscard]] static constexpr std::size_t mostBytes(const AccountingDepth& depth) {
        return 2 * SampleWindow::mostBytes(depth.samples) + CountHistory::mostBytes(depth.buckets) +
               Probation::kMost * (sizeof(Probation::Waiting) + sizeof(Verdict)) + MessageRounds::kMostBytes;
    }

    /// The sender had stopped to send the stream, and sends it again: what it did not send is not missing.
    void beginRun(log::Stamp stamp);
    /// A datagram of the stream that could not be decoded.
    void addMalformed(log::Stamp stamp);

    // Figures of all there is, or of a range of time, at a cost that does not depend on it. The ends are
    // rounded to the resolution, but for edges. What belongs to samples counts when they were due.
    using Range = std::optional<TimeRange>;
    [[nodiscard]] StreamCounts counts(const Range& range = {}) const;
    [[nodiscard]] StreamCounts countsBetween(log::Stamp from, log::Stamp to) const;
    [[nodiscard]] InterArrival interArrival(const Range& range = {}) const;
    /// A burst counts where it ended.
    [[nodiscard]] LossPattern lossPattern(const Range& range = {}) const;
    /// The jitter at the end of the range; skew and drift from its beginning or the newest restart in it on.
    [[nodiscard]] ClockFigures clock(const Range& range = {}) const;
    [[nodiscard]] std::uint64_t malformed(const Range& range = {}) const;
    /// From a stamp on: 0.1 s for what is new, and ever more for what is old.
    [[nodiscard]] log::Duration resolution(log::Stamp from = log::Stamp::min()) const {
        return m_history.width(from);
    }
    [[nodiscard]] const CountHistory& history() const { return m_history; }
    /// At the newest sample.
    [[nodiscard]] const SenderClock& senderClock() const { return m_clock; }

    /// Calls f(sample, stamp) for the samples between two counters, both exclusive, that came and are
    /// remembered; after a restart those of before it first.
    template <class Function>
    void forEachBetween(std::uint32_t from, std::uint32_t to, Function&& f) const {
        for (const SampleSequence* sequence : {&m_ledger.before(), &m_ledger.present()}) {
            const SampleWindow& window = sequence->window();
            for (std::size_t i = window.find(from + 1).index; i < window.size(); ++i) {
                const SampleWindow::Entry& entry = window[i];
                if (distance(entry.sample, to) >= 0 || distance(from, entry.sample) >= 0) {
                    break;
                }
                f(entry.sample, entry.stamp);
            }
        }
    }
    /// True if some but not all datagrams of a sample came. After a restart, samples of before are known for
    /// a while.
    [[nodiscard]] bool isIncomplete(std::uint32_t sample) const;

    /// Samples between two counters, both exclusive, that are still missing; empty if the first of them
    /// is forgotten.
    [[nodiscard]] std::optional<std::uint32_t> missingBetween(std::uint32_t from, std::uint32_t to) const;

    /// The first packet of the newest message of types 10 to 13, where that still lacks something.
    [[nodiscard]] std::optional<std::uint64_t> partialMessage() const {
        return m_rounds.isPartial() ? std::optional(m_messagePacket) : std::nullopt;
    }
    [[nodiscard]] std::uint64_t datagrams() const { return m_datagrams; }
    [[nodiscard]] std::uint32_t step() const { return m_ledger.present().step(); }
    /// That of a sample which came; 0 if it is not known, or the sample is forgotten.
    [[nodiscard]] std::uint32_t stepAt(std::uint32_t sample) const;
    [[nodiscard]] const Framing& framing() const { return m_framing; }
    /// The sample counter stands while what is sent changes: its datagrams are counted instead.
    [[nodiscard]] bool isUncounted() const { return m_isUncounted; }
    [[nodiscard]] bool isInDoubt() const { return !m_probation.empty() || m_repeat; }
    /// The first packet that waits for what comes after it; UINT64_MAX for none.
    [[nodiscard]] std::uint64_t firstInDoubt() const {
        return !m_probation.empty() ? m_probation.waiting()[0].packet
               : m_repeat           ? m_repeat->packet
                                    : UINT64_MAX;
    }
    [[nodiscard]] log::Stamp firstStamp() const { return m_firstStamp; }
    [[nodiscard]] log::Stamp lastStamp() const { return m_lastStamp; }

private:
    /// The one that remembers a sample; null for none.
    [[nodiscard]] const SampleSequence* sequenceOf(std::uint32_t sample) const;

    static constexpr std::uint64_t kUncertain = 128; ///< datagrams of a run

    void takeCounter(Probation::Waiting& datagram, wire::Bytes bytes);
    void takeSample(Probation::Waiting& datagram);
    void endDoubt(bool isEnd);
    void settle(const Probation::Waiting& datagram, Probation::Outcome outcome, bool isMoved);

    bool m_countsSamples;
    Framing m_framing;
    bool m_isUncounted = false;
    std::uint32_t m_added = 0;                  ///< to the sender's counter, for samples it did not count
    std::optional<Probation::Waiting> m_repeat; ///< of the datagram before with other bytes
    SampleLedger::Datagram m_newest;            ///< as on the wire
    std::array<std::byte, kTelling> m_newestBytes{}; ///< its beginning
    AccountingDepth m_depth;
    std::uint64_t m_datagrams = 0;
    std::uint64_t m_bytes = 0;
    std::uint64_t m_malformed = 0;
    std::uint64_t m_passedOver = 0;           ///< packets since the newest datagram
    std::uint64_t m_certainFrom = kUncertain; ///< datagrams, by which its run has its step
    log::Stamp m_firstStamp{};
    log::Stamp m_lastStamp{};
    std::optional<log::Stamp> m_lastSample{}; ///< stamp of the newest first arrival of a sample
    Probation::Waiting m_highest;             ///< the first datagram of the highest sample
    SampleLedger m_ledger;
    Probation m_probation;
    MessageRounds m_rounds;
    std::uint64_t m_repeats = 0;       ///< datagrams of messages that came twice
    std::uint64_t m_messagePacket = 0; ///< the first of the newest message
    SenderClock m_clock;
    CountHistory m_history;
    std::vector<Verdict> m_verdicts;
};

} // namespace posewire::model
