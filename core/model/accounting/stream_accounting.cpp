// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_accounting.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace posewire::model {
namespace {

constexpr TimeRange kEver{log::Stamp::min(), log::Stamp::max()};

/// True if a counter is ahead by what was passed over at most.
bool isAfterPassedOver(std::uint64_t packets, const SampleSequence& present, std::uint32_t sample) {
    if (packets == 0 || present.empty()) {
        return false;
    }
    const std::int32_t moved = distance(sample, present.highest());
    return moved > 0 && static_cast<std::uint64_t>(moved) <= (packets + 1) * std::max(present.step(), 1U);
}

/// `isMoved`: the counter restarted among those that waited, so that what was expected before is now past.
Placement carryOut(const Probation::Waiting& datagram, Probation::Outcome outcome, bool isMoved,
                   SampleLedger& ledger, CountHistory* history) {
    switch (outcome) {
    case Probation::Outcome::Restarted:
        ledger.begin(datagram.datagram.stamp, history, true);
        return ledger.place(datagram.datagram, history);
    case Probation::Outcome::Begun:
        return ledger.place(datagram.datagram, history);
    case Probation::Outcome::Expected:
        return isMoved ? ledger.placeBefore(datagram.datagram, history)
                       : ledger.place(datagram.datagram, history);
    case Probation::Outcome::Alone:
        break;
    }
    return ledger.placeAlone(datagram.datagram, history);
}

/// With what is in doubt decided as it would be if nothing followed.
SampleLedger inHindsight(SampleLedger ledger, const Probation& probation,
                         const std::optional<Probation::Waiting>& repeat) {
    Probation::Decision decision;
    probation.decide(ledger, true, decision);
    bool isMoved = false;
    for (std::size_t i = 0; i < decision.decided; ++i) {
        carryOut(probation.waiting()[i], decision.outcomes[i], isMoved, ledger, nullptr);
        isMoved = isMoved || decision.outcomes[i] == Probation::Outcome::Restarted;
    }
    if (repeat) {
        ledger.place(repeat->datagram, nullptr);
    }
    return ledger;
}

} // namespace

MessageRounds::Place MessageRounds::add(log::Stamp stamp, std::uint8_t datagram, bool isLast,
                                        std::size_t digest) {
    const bool isOfSeveral = datagram != 0 || !isLast; // a whole message may be sent again as it is
    const bool isRepeat = isOfSeveral && std::ranges::any_of(m_parts, [&](const Part& part) {
                              return part.datagram == datagram && part.digest == digest &&
                                     std::chrono::abs(stamp - part.stamp) <= kTogether;
                          });
    if (isRepeat) {
        return Place::Repeats;
    }
    auto arrived = m_arrived[datagram & 127];
    const bool isBegin = m_arrived.none() || arrived || std::chrono::abs(stamp - m_first) > kTogether;
    if (isBegin) {
        m_arrived.reset();
        m_parts.clear();
        m_last = -1;
        m_first = stamp;
    } else {
        m_incomplete -= isWhole() ? 0 : 1;
    }
    arrived = true;
    m_parts.push_back({stamp, datagram, digest});
    m_last = isLast ? datagram : m_last;
    m_incomplete += isWhole() ? 0 : 1;
    return isBegin ? Place::Begins : Place::GoesOn;
}

std::span<const Verdict> StreamAccounting::add(const log::Packet& packet, const wire::Header& header) {
    m_verdicts.clear();
    m_firstStamp = m_datagrams == 0 ? packet.stamp : m_firstStamp;
    m_lastStamp = packet.stamp;
    ++m_datagrams;
    m_bytes += packet.bytes.size();
    CountHistory::Counters change{.bytes = packet.bytes.size(), .datagrams = 1};
    if (m_countsSamples) {
        m_history.add(packet.stamp, change);
        Probation::Waiting datagram{
            {packet.stamp, header.sampleCounter, header.datagramIndex(), header.isLast()},
            packet.number,
            header.timeCode,
            false};
        takeCounter(datagram, packet.bytes.first(std::min(packet.bytes.size(), kTelling)));
        return m_verdicts;
    }
    const std::uint64_t incomplete = m_rounds.incomplete();
    const bool isPartial = m_rounds.isPartial();
    const MessageRounds::Place place =
        m_rounds.add(packet.stamp, header.datagramIndex(), header.isLast(), wire::hashOf(packet.bytes));
    const bool isBegin = place == MessageRounds::Place::Begins;
    change.duplicates = place == MessageRounds::Place::Repeats ? 1 : 0;
    m_repeats += change.duplicates;
    change.incomplete = static_cast<std::uint32_t>(m_rounds.incomplete() - incomplete);
    m_history.add(packet.stamp, change);
    m_verdicts.push_back({.packet = packet.number,
                          .stamp = packet.stamp,
                          .sample = header.sampleCounter,
                          .packetBefore = m_messagePacket,
                          .isDuplicate = change.duplicates != 0,
                          .isAfterPartial = isBegin && isPartial});
    m_messagePacket = isBegin ? packet.number : m_messagePacket;
    return m_verdicts;
}

/// Senders exist whose counter stands. One datagram that repeats the counter of the one before with other
/// bytes may be a damaged copy and waits; the second in a row shows that both are samples of their own.
void StreamAccounting::takeCounter(Probation::Waiting& datagram, wire::Bytes bytes) {
    const SampleLedger::Datagram before = std::exchange(m_newest, datagram.datagram);
    const bool isStanding =
        m_datagrams > 1 && before.sample == m_newest.sample && before.index == 0 && m_newest.index == 0;
    const bool isRepeat = isStanding && !std::equal(bytes.begin(), bytes.end(), m_newestBytes.begin());
    if (bytes.size() == kTelling) { // nearly all: of a known size it costs nothing
        std::memcpy(m_newestBytes.data(), bytes.data(), kTelling);
    } else {
        std::ranges::copy(bytes, m_newestBytes.begin());
    }
    datagram.datagram.sample += m_added;
    if (isRepeat && !m_repeat && !m_isUncounted) {
        m_repeat = datagram;
        return;
    }
    const std::uint32_t step = isRepeat ? std::max(this->step(), 1U) : 0;
    std::uint32_t added = 0;
    if (m_repeat) {
        added = step;
        Probation::Waiting repeat = *std::exchange(m_repeat, std::nullopt);
        repeat.datagram.sample += added;
        takeSample(repeat);
    }
    m_isUncounted = isRepeat || (isStanding && m_isUncounted);
    added += step;
    m_added += added;
    datagram.datagram.sample += added;
    takeSample(datagram);
}

void StreamAccounting::beginRun(log::Stamp stamp) {
    if (m_countsSamples && !isInDoubt() && !m_ledger.present().empty()) {
        m_ledger.begin(stamp, &m_history, false);
        m_lastSample.reset();
        m_certainFrom = m_datagrams + kUncertain;
    }
}

void StreamAccounting::setDepth(const AccountingDepth& depth) {
    m_depth = depth;
    m_ledger.setMost(depth.samples, &m_history);
    m_history.setMost(depth.buckets);
}

std::size_t StreamAccounting::memoryBytes() const {
    return m_ledger.memoryBytes() + m_history.memoryBytes() + m_probation.memoryBytes() +
           m_rounds.memoryBytes() + m_verdicts.capacity() * sizeof(Verdict);
}

void StreamAccounting::takeSample(Probation::Waiting& datagram) {
    SampleLedger::Datagram& part = datagram.datagram;
    if (m_framing.add(part.sample, part.index, part.isLast, m_ledger.present())) {
        m_ledger.completeAll(&m_history, [&](std::uint32_t sample) {
            m_verdicts.push_back(
                {.packet = datagram.packet, .stamp = part.stamp, .sample = sample, .isCompleting = true});
        });
    }
    part.isLast = part.isLast || m_framing.isUnmarked();
    const bool isExplained = isAfterPassedOver(m_passedOver, m_ledger.present(), datagram.datagram.sample);
    m_passedOver = 0;
    if (m_probation.empty() && (isExplained || Probation::isExpected(m_ledger, datagram.datagram))) {
        settle(datagram, Probation::Outcome::Expected, false);
        return;
    }
    m_probation.add(datagram);
    endDoubt(false);
}

std::span<const Verdict> StreamAccounting::conclude() {
    m_verdicts.clear();
    if (m_repeat) {
        Probation::Waiting repeat = *std::exchange(m_repeat, std::nullopt);
        takeSample(repeat);
    }
    if (!m_probation.empty()) {
        endDoubt(true);
    }
    m_ledger.conclude(&m_history);
    return m_verdicts;
}

void StreamAccounting::endDoubt(bool isEnd) {
    Probation::Decision decision;
    m_probation.decide(m_ledger, isEnd, decision);
    bool isMoved = false;
    for (std::size_t i = 0; i < decision.decided; ++i) {
        settle(m_probation.waiting()[i], decision.outcomes[i], isMoved);
        isMoved = isMoved || decision.outcomes[i] == Probation::Outcome::Restarted;
    }
    m_probation.drop(decision.decided);
}

void StreamAccounting::settle(const Probation::Waiting& datagram, Probation::Outcome outcome, bool isMoved) {
    const Placement placement = carryOut(datagram, outcome, isMoved, m_ledger, &m_history);
    Verdict& verdict = m_verdicts.emplace_back();
    verdict.packet = datagram.packet;
    verdict.stamp = datagram.datagram.stamp;
    verdict.sample = datagram.datagram.sample;
    verdict.gap = placement.gap;
    verdict.timeCode = datagram.timeCode;
    // Before the step is certain, whether samples are missing is known later.
    verdict.mayBeGap = placement.kind == Placement::Kind::Advance && placement.gap == 0 &&
                       m_datagrams < m_certainFrom && outcome != Probation::Outcome::Restarted &&
                       m_lastSample.has_value() && distance(verdict.sample, placement.sampleBefore) > 1;
    if (placement.gap != 0 || verdict.mayBeGap) {
        verdict.sampleBefore = placement.sampleBefore;
        verdict.timeCodeBefore = m_highest.timeCode;
        verdict.packetBefore = m_highest.packet;
        verdict.stampBefore = m_highest.datagram.stamp;
    }
    verdict.isDuplicate = placement.kind == Placement::Kind::Duplicate;
    verdict.isReordered = placement.isReordered;
    verdict.isRestart = outcome == Probation::Outcome::Restarted;
    verdict.isCompleting = placement.isCompleting;
    verdict.isStray = placement.kind == Placement::Kind::Outside;
    verdict.isFirstOfSample =
        placement.kind == Placement::Kind::Advance || placement.kind == Placement::Kind::Filled;
    const bool isPast = isMoved && outcome == Probation::Outcome::Expected;
    if (!verdict.isFirstOfSample || isPast || outcome == Probation::Outcome::Alone) {
        return;
    }
    if (verdict.isRestart) {
        m_clock.restart();
        m_certainFrom = m_datagrams + kUncertain;
    }
    if (placement.kind == Placement::Kind::Advance) {
        m_highest = datagram;
    }
    m_clock.add({verdict.stamp, verdict.sample, datagram.timeCode});
    if (m_lastSample) {
        m_history.addArrival(verdict.stamp, std::max(log::Duration::zero(), verdict.stamp - *m_lastSample),
                             m_clock.jitterMs());
    }
    m_history.addDifference(verdict.stamp, m_clock.differenceMs(), m_clock.generation());
    m_lastSample = verdict.stamp;
}

StreamCounts StreamAccounting::counts(const Range& range) const {
    if (range) {
        return countsBetween(range->from, range->to);
    }
    StreamCounts counts =
        isInDoubt() ? inHindsight(m_ledger, m_probation, m_repeat).counts() : m_ledger.counts();
    counts.datagrams = m_datagrams;
    counts.bytes = m_bytes;
    if (!m_countsSamples) {
        counts.incomplete = m_rounds.incomplete();
        counts.duplicates = m_repeats;
    }
    return counts;
}

StreamCounts StreamAccounting::countsBetween(log::Stamp from, log::Stamp to) const {
    StreamCounts counts = m_history.countsBetween(from, to);
    counts.step = step();
    return counts;
}

InterArrival StreamAccounting::interArrival(const Range& range) const {
    const auto [from, to] = range.value_or(kEver);
    return m_history.arrivalsBetween(from, to);
}

LossPattern StreamAccounting::lossPattern(const Range& range) const {
    const TimeRange when = range.value_or(kEver);
    BurstCounts bursts = m_history.burstsBetween(when.from, when.to);
    m_ledger.addNewestBursts(when, bursts);
    return patternOf(bursts, counts(range));
}

ClockFigures StreamAccounting::clock(const Range& range) const {
    const bool isFromTimeCode = m_clock.isFromTimeCode();
    const auto [from, to] = range.value_or(kEver);
    return {isFromTimeCode, range ? m_history.jitterMsAt(to) : m_clock.jitterMs(),
            isFromTimeCode ? m_history.skewBetween(from, to) : ClockSkew{}};
}

std::uint64_t StreamAccounting::malformed(const Range& range) const {
    return range ? m_history.malformedBetween(range->from, range->to) : m_malformed;
}

void StreamAccounting::addMalformed(log::Stamp stamp) {
    ++m_malformed;
    m_history.add(stamp, {.malformed = 1});
}

const SampleSequence* StreamAccounting::sequenceOf(std::uint32_t sample) const {
    for (const SampleSequence* sequence : {&m_ledger.present(), &m_ledger.before()}) {
        if (sequence->window().find(sample).isThere) {
            return sequence;
        }
    }
    return nullptr;
}

bool StreamAccounting::isIncomplete(std::uint32_t sample) const {
    const SampleSequence* sequence = sequenceOf(sample);
    return sequence != nullptr && !sequence->window()[sequence->window().find(sample).index].isComplete;
}

std::optional<std::uint32_t> StreamAccounting::missingBetween(std::uint32_t from, std::uint32_t to) const {
    const SampleSequence* sequence = sequenceOf(from);
    return sequence != nullptr ? std::optional(sequence->missingBetween(from, to)) : std::nullopt;
}

std::uint32_t StreamAccounting::stepAt(std::uint32_t sample) const {
    const SampleSequence* sequence = sequenceOf(sample);
    return sequence != nullptr ? sequence->step() : 0;
}

} // namespace posewire::model
