// SPDX-License-Identifier: MIT
#include "core/model/accounting/attribution.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

namespace posewire::model {
namespace {

constexpr std::size_t kMostDrops = 4'096;
constexpr std::size_t kMostDamages = 1'024;
// After samples that came later than that, more is waited for; for as long.
constexpr log::Duration kMostPatience = std::chrono::seconds(2);
constexpr log::Duration kForgetLate = std::chrono::seconds(30);
// Where stamps freeze nothing becomes due.
constexpr std::size_t kMostPartials = 65'536;
constexpr std::size_t kMostSilences = 64;
// A sender with more streams than these is no performance.
constexpr std::size_t kMostStreams = 64;
// Late arrivals are looked for among this many gaps of a stream, or incomplete samples, and not farther back
// than that many gaps of all.
constexpr std::size_t kMostBack = 1'024;
constexpr std::size_t kMostLooked = 8'192;
// Judged partials that are remembered: those of a range of time are looked up among them.
constexpr std::size_t kMostJudged = 16'384;
// So many equal gaps in a row may be the spacing of a new rate.
constexpr std::uint32_t kEven = 3;
// How often gaps that may be one are looked at.
constexpr log::Duration kHeldCheck = std::chrono::milliseconds(50);

// Datagrams of a stream after which nothing of it waits to be judged any longer.
std::uint64_t mostWaiting(const Stream& stream) {
    return stream.accounting.depth().samples / 4;
}

/// Adds a value; the oldest goes where there are too many.
template <class Value>
void keepNewest(std::deque<Value>& values, const Value& value, std::size_t most) {
    values.push_back(value);
    if (values.size() > most) {
        values.pop_front();
    }
}

} // namespace

void Attribution::addStream(Stream& stream, const log::SenderInfo& info) {
    Sender& sender = m_senders[stream.key.sender];
    sender.transport = info.transport;
    sender.localPort = info.localPort;
    if (countsSamples(stream.key.type) && sender.streams.size() < kMostStreams) {
        sender.streams.push_back(&stream);
    }
}

void Attribution::retire(log::SenderId sender) {
    m_senders.erase(sender);
    const auto forget = [sender](auto& waiting) {
        for (auto& one : waiting) {
            one.stream = one.stream != nullptr && one.stream->key.sender == sender ? nullptr : one.stream;
        }
    };
    forget(m_due);
    forget(m_held);
    forget(m_open);
    forget(m_rests);
    const auto isOf = [sender](const Partial& partial) { return partial.stream->key.sender == sender; };
    std::erase_if(m_judgedPartials, isOf);
    // Others know these by their place.
    for (Partial& partial : m_partials) {
        partial.stream = partial.stream != nullptr && isOf(partial) ? nullptr : partial.stream;
    }
}

void Attribution::takePacket(const log::Packet& packet, std::uint16_t localPort) {
    // First what it says of itself: it may be why something before it is due.
    if (packet.kernelDropsBefore != 0) {
        keepNewest(m_drops, {packet.number, std::uint64_t{packet.kernelDropsBefore}, localPort}, kMostDrops);
    }
    if (packet.flags.afterClosed) {
        keepNewest(m_drops, {packet.number, 0, localPort, true}, kMostDrops);
    }
    judgeDue(packet.stamp, packet.number);
    m_lastPacket = packet.number;
}

void Attribution::advance(log::Stamp stamp) {
    judgeDue(stamp, m_lastPacket + 1);
}

/// By the packets up to one.
void Attribution::judgeDue(log::Stamp stamp, std::uint64_t packet, bool isAll) {
    if (m_lateSeen && stamp - *m_lateSeen > kForgetLate) {
        m_patience = kPatience;
        m_lateSeen.reset();
    }
    for (; !m_due.empty(); m_due.pop_front()) {
        Due& due = m_due.front();
        const Gap* gap = due.stream != nullptr ? find(due.gap) : nullptr;
        if (!isAll && gap != nullptr && stamp - gap->toStamp < m_patience) {
            break;
        }
        if (!isAll && mayBeStep(due, stamp)) {
            m_held.push_back(due);
        } else {
            judge(due);
        }
    }
    if (isAll || stamp >= m_nextHeld) {
        judgeHeld(stamp, isAll);
    }
    for (; !m_open.empty() && (isAll || stamp - m_open.front().stamp > MessageRounds::kTogether ||
                               m_open.size() > kMostPartials);
         m_open.pop_front()) {
        judge(m_open.front(), packet);
    }
    for (; !m_partials.empty() &&
           (isAll || m_partials.front().stream == nullptr || stamp - m_partials.front().stamp >= kPatience ||
            m_partials.size() > kMostPartials);
         m_partials.pop_front(), ++m_firstPartial) {
        judge(m_partials.front(), packet);
    }
    for (; !m_rests.empty() && (isAll || stamp - m_rests.front().stamp >= m_patience); m_rests.pop_front()) {
        if (Stream* const stream = m_rests.front().stream) {
            stream->awaitsRest = false;
            attributeRest(*stream);
        }
    }
}

void Attribution::takeOvertaken(std::uint64_t packet, std::uint64_t count) {
    keepNewest(m_drops, {packet, count, std::nullopt}, kMostDrops);
}

void Attribution::takeSampled(log::SenderId sender, log::Stamp stamp) {
    const auto found = m_senders.find(sender);
    if (found == m_senders.end()) {
        return;
    }
    Sender& figures = found->second;
    if (figures.lastStamp != log::Stamp() && stamp - figures.lastStamp >= kPause) {
        keepNewest(figures.silences, {figures.lastStamp, stamp}, kMostSilences);
    }
    figures.lastStamp = stamp;
}

void Attribution::takeMalformed(const log::Packet& packet, const wire::Header& header) {
    keepNewest(m_damages,
               {{packet.sender, header.character, header.type()}, header.sampleCounter, packet.number},
               kMostDamages);
}

void Attribution::takeVerdict(Stream& stream, const Verdict& verdict) {
    const std::uint32_t step = stream.accounting.step();
    if (stream.accounting.datagrams() >= stream.judgeAt) {
        judgeEarly(stream, verdict.packet);
    }
    noteSpacing(stream, verdict);
    countsSamples(stream.key.type) ? takePartial(stream, verdict) : takeMessage(stream, verdict);
    if (verdict.gap != 0 || verdict.mayBeGap) {
        m_gaps.push_back({.stream = stream.key,
                          .fromSample = verdict.sampleBefore,
                          .toSample = verdict.sample,
                          .fromStamp = verdict.stampBefore,
                          .toStamp = verdict.stamp,
                          .fromPacket = verdict.packetBefore,
                          .toPacket = verdict.packet,
                          .lost = verdict.gap,
                          .timeCodeMoved = verdict.timeCode - verdict.timeCodeBefore});
        m_due.push_back({m_firstGap + m_gaps.size() - 1, &stream, stream.accounting.datagrams()});
        expectJudgement(stream);
        if (m_gaps.size() > kMostGaps) {
            for (std::deque<Due>* dues : {&m_held, &m_due}) {
                if (!dues->empty() && dues->front().gap == m_firstGap) {
                    judge(dues->front());
                    dues->pop_front();
                }
            }
            m_gaps.pop_front();
            ++m_firstGap;
        }
    } else if (verdict.isReordered && verdict.isFirstOfSample) {
        if (const Gap* gap = recount(stream, verdict.sample)) { // it came after all
            learnPatience(*gap, verdict.stamp);
        } else if (!std::exchange(stream.awaitsRest, true)) { // it may be from before the first one
            m_rests.push_back({&stream, verdict.stamp});
        }
    }
    if (step != stream.judgedStep) {
        // Known in hindsight: what seemed lost may not be.
        stream.judgedStep = step;
        recount(stream, {});
        if (!std::exchange(stream.awaitsRest, true)) {
            m_rests.push_back({&stream, verdict.stamp});
        }
    }
}

/// Where samples come later than they were waited for, the next ones are waited for longer.
void Attribution::learnPatience(const Gap& gap, log::Stamp stamp) {
    if (gap.isJudged) {
        const log::Duration late = stamp - gap.toStamp;
        m_patience = std::clamp(late + late / 2, m_patience, kMostPatience);
        m_lateSeen = stamp;
    }
}

/// Gaps in a row that are all multiples of one spacing may be a new step of the sender, losses among them.
void Attribution::noteSpacing(Stream& stream, const Verdict& verdict) {
    if (!verdict.isFirstOfSample || verdict.isReordered) {
        return;
    }
    const std::uint32_t spacing = verdict.gap != 0 ? verdict.sample - verdict.sampleBefore : 0;
    const std::uint32_t common = std::gcd(stream.evenSpacing, spacing);
    const bool isMore = spacing != 0 && stream.evenGaps != 0 && common > stream.accounting.step();
    stream.evenGaps = isMore ? stream.evenGaps + 1 : spacing != 0 ? 1 : 0;
    stream.evenSpacing = isMore ? common : spacing;
}

/// True if a gap that is due is one of several that are alike, or may become one, and the stream still goes
/// on like that.
bool Attribution::mayBeStep(const Due& due, log::Stamp stamp) const {
    const Gap* gap = due.stream != nullptr ? find(due.gap) : nullptr;
    const bool isEven = gap != nullptr && gap->lost != 0 && due.stream->evenGaps != 0 &&
                        (gap->toSample - gap->fromSample) % due.stream->evenSpacing == 0;
    if (!isEven) {
        return false;
    }
    const log::Duration lasted = gap->toStamp - gap->fromStamp;
    const log::Duration patience = due.stream->evenGaps >= kEven ? std::max(kMostPatience, 3 * lasted)
                                                                 : std::min(kMostPatience, 3 * lasted / 2);
    return stamp - due.stream->accounting.lastStamp() < patience;
}

void Attribution::judgeHeld(log::Stamp stamp, bool isAll) {
    m_nextHeld = stamp + kHeldCheck;
    std::erase_if(m_held, [&](Due& due) {
        const bool isOver = isAll || !mayBeStep(due, stamp);
        if (isOver) {
            judge(due);
        }
        return isOver;
    });
}

void Attribution::takeMessage(Stream& stream, const Verdict& verdict) {
    if (verdict.isAfterPartial && stream.judgedMessage != verdict.packetBefore) {
        judgeMessage(stream, verdict.stamp, verdict.packetBefore, verdict.packet);
    }
    if (stream.accounting.partialMessage() == verdict.packet) {
        m_open.push_back({&stream, verdict.stamp, verdict.packet});
    }
}

/// Nothing more comes of it, whether or not there is a next one.
void Attribution::judge(OpenMessage& message, std::uint64_t packet) {
    Stream* const stream = message.stream;
    if (stream != nullptr && stream->accounting.partialMessage() == message.packet) {
        stream->judgedMessage = message.packet;
        judgeMessage(*stream, message.stamp, message.packet, packet);
    }
}

void Attribution::judgeMessage(Stream& stream, log::Stamp stamp, std::uint64_t fromPacket,
                               std::uint64_t toPacket) {
    Partial partial{&stream, 0, stamp, fromPacket};
    partial.cause = causeOfPartial(stream.key, fromPacket, toPacket);
    partial.incident = attribute(stream, {.stream = stream.key,
                                          .cause = partial.cause,
                                          .samples = 1,
                                          .from = stamp,
                                          .to = stamp,
                                          .fromPacket = fromPacket,
                                          .toPacket = toPacket,
                                          .evidence = {words::Kind::PartOfMessage}});
    keepNewest(m_judgedPartials, partial, kMostJudged);
}

/// Notes what lacks a part, and what does not any more.
void Attribution::takePartial(Stream& stream, const Verdict& verdict) {
    std::uint64_t& open = stream.openPartial;
    if (verdict.isFirstOfSample && !verdict.isReordered && open > m_firstPartial) {
        m_partials[open - m_firstPartial - 1].nextPacket = verdict.packet;
        open = 0;
    }
    if (verdict.isFirstOfSample && !verdict.isCompleting) {
        m_partials.push_back(
            {&stream, verdict.sample, verdict.stamp, verdict.packet, stream.accounting.datagrams()});
        expectJudgement(stream);
        open = verdict.isReordered ? open : m_firstPartial + m_partials.size();
    } else if (verdict.isCompleting && !verdict.isFirstOfSample) {
        complete(stream, verdict.sample);
    }
}

/// By the packets up to one.
void Attribution::judge(Partial& partial, std::uint64_t packet) {
    Stream* const stream = std::exchange(partial.stream, nullptr);
    if (stream == nullptr || !stream->accounting.isIncomplete(partial.sample)) {
        return;
    }
    partial.cause =
        causeOfPartial(stream->key, partial.packet, partial.nextPacket != 0 ? partial.nextPacket : packet);
    partial.incident =
        attribute(*stream, {.stream = stream->key,
                            .cause = partial.cause,
                            .samples = 1,
                            .from = partial.stamp,
                            .to = partial.stamp,
                            .fromPacket = partial.packet,
                            .toPacket = partial.packet,
                            .evidence = {words::Kind::PartOfSample,
                                         {{"sample", words::Number{static_cast<double>(partial.sample)}}}}});
    keepNewest(m_judgedPartials, partial, kMostJudged);
    m_judgedPartials.back().stream = stream;
}

/// A stream remembers only its newest samples: by then at the latest.
void Attribution::expectJudgement(Stream& stream) {
    stream.judgeAt = std::min(stream.judgeAt, stream.accounting.datagrams() + mostWaiting(stream));
}

/// In a flood the samples around a gap are forgotten before late arrivals have had their time.
void Attribution::judgeEarly(Stream& stream, std::uint64_t packet) {
    const std::uint64_t datagrams = stream.accounting.datagrams();
    stream.judgeAt = UINT64_MAX;
    const auto isWaiting = [&](std::uint64_t since) {
        const std::uint64_t most = mostWaiting(stream);
        const bool isYoung = datagrams - since < most / 2;
        stream.judgeAt = std::min(stream.judgeAt, isYoung ? since + most : UINT64_MAX);
        return isYoung;
    };
    for (auto* dues : {&m_held, &m_due}) {
        for (Due& due : *dues) {
            if (due.stream == &stream && !isWaiting(due.datagrams)) {
                judge(due);
            }
        }
    }
    for (Partial& partial : m_partials) {
        if (partial.stream == &stream && !isWaiting(partial.datagrams)) {
            judge(partial, packet);
        }
    }
}

/// The missing part of a sample came after all.
void Attribution::complete(Stream& stream, std::uint32_t sample) {
    const auto newest = m_judgedPartials.end();
    const auto oldest = newest - static_cast<std::ptrdiff_t>(std::min(kMostBack, m_judgedPartials.size()));
    const auto found = std::find_if(oldest, newest, [&](const Partial& partial) {
        return partial.stream == &stream && partial.sample == sample;
    });
    if (found != newest) {
        --stream.attributed[static_cast<std::size_t>(found->cause)];
        m_sink->takeBack(found->incident, stream.key, 1, true);
        m_judgedPartials.erase(found);
    }
}

std::size_t Attribution::memoryBytes() const {
    std::size_t bytes = m_gaps.size() * sizeof(Gap) + (m_due.size() + m_held.size()) * sizeof(Due) +
                        m_open.size() * sizeof(OpenMessage) +
                        (m_partials.size() + m_judgedPartials.size()) * sizeof(Partial) +
                        m_drops.size() * sizeof(Drop) + m_damages.size() * sizeof(Damage);
    for (const auto& [id, sender] : m_senders) {
        bytes += sizeof(Sender) + sender.silences.size() * sizeof(TimeRange) +
                 sender.streams.capacity() * sizeof(const Stream*);
    }
    return bytes;
}

const Gap* Attribution::endedBy(std::uint64_t packet) const {
    const auto found = std::ranges::lower_bound(m_gaps, packet, {}, &Gap::toPacket);
    return found != m_gaps.end() && found->toPacket == packet ? &*found : nullptr;
}

std::uint64_t Attribution::firstPending(log::Stamp after) const {
    std::uint64_t first = UINT64_MAX;
    for (const auto* dues : {&m_due, &m_held}) {
        const auto pending = std::ranges::find_if(*dues, [&](const Due& due) {
            const Gap* gap = due.stream != nullptr ? find(due.gap) : nullptr;
            return gap != nullptr && gap->toStamp > after;
        });
        first = pending == dues->end() ? first : std::min(first, find(pending->gap)->toPacket);
    }
    return first;
}

std::uint64_t Attribution::attribute(Stream& stream, Loss loss) {
    stream.attributed[static_cast<std::size_t>(loss.cause)] += loss.samples;
    return m_sink->takeLoss(std::move(loss));
}

/// Samples from before the step was known: in hindsight they are lost, or are not, and no gap was seen.
void Attribution::attributeRest(Stream& stream) {
    const StreamCounts counts = stream.accounting.counts();
    std::uint64_t told = 0;
    for (const std::uint64_t samples : stream.attributed) {
        told += samples;
    }
    for (const auto* dues : {&m_due, &m_held}) {
        for (const Due& due : *dues) {
            const Gap* gap = due.stream == &stream ? find(due.gap) : nullptr;
            told += gap != nullptr ? gap->lost : 0;
        }
    }
    for (const Partial& partial : m_partials) {
        told += partial.stream == &stream && stream.accounting.isIncomplete(partial.sample) ? 1 : 0;
    }
    const std::uint64_t missing = counts.lost + counts.incomplete;
    if (missing > told) {
        stream.restIncident = attribute(stream, {.stream = stream.key,
                                                 .samples = missing - told,
                                                 .from = stream.accounting.firstStamp(),
                                                 .to = stream.accounting.lastStamp(),
                                                 .fromPacket = m_lastPacket,
                                                 .toPacket = m_lastPacket,
                                                 .incident = stream.restIncident,
                                                 .evidence = {words::Kind::AsStreamBegan}});
        stream.restSamples += missing - told;
    } else if (const std::uint64_t less = std::min(told - missing, stream.restSamples); less != 0) {
        stream.restSamples -= less;
        stream.attributed[static_cast<std::size_t>(LossCause::Unknown)] -= less;
        m_sink->takeBack(stream.restIncident, stream.key, less, stream.restSamples == 0);
    }
}

Loss Attribution::lossOf(const Gap& gap, std::uint64_t samples) {
    return {.stream = gap.stream,
            .cause = gap.cause,
            .samples = samples,
            .from = gap.fromStamp,
            .to = gap.toStamp,
            .fromPacket = gap.fromPacket,
            .toPacket = gap.toPacket,
            .incident = gap.incident,
            .evidence = gap.evidenceFact()};
}

/// Counts again what a gap still lacks, in it and in the sums of its stream.
void Attribution::recount(Gap& gap, Stream& stream) {
    const std::uint32_t lost =
        stream.accounting.missingBetween(gap.fromSample, gap.toSample).value_or(gap.lost);
    const std::uint32_t before = std::exchange(gap.lost, lost);
    if (lost != before) {
        m_recounts.push_back({gap.toPacket, lost});
    }
    if (!gap.isJudged || lost == before) {
        return;
    }
    if (before == 0 && gap.evidence == Gap::Evidence::None) {
        findCause(gap, stream);
    }
    if (lost > before) {
        gap.incident = attribute(stream, lossOf(gap, lost - before));
        return;
    }
    std::uint64_t& sum = stream.attributed[static_cast<std::size_t>(gap.cause)];
    const std::uint64_t less = std::min<std::uint64_t>(sum, before - lost);
    sum -= less;
    m_sink->takeBack(gap.incident, gap.stream, less, lost == 0);
}

/// Once.
void Attribution::judge(Due& due) {
    Stream* const stream = std::exchange(due.stream, nullptr);
    Gap* const gap = find(due.gap);
    if (stream == nullptr || gap == nullptr) {
        return;
    }
    recount(*gap, *stream);
    findCause(*gap, *stream);
    gap->isJudged = true;
    if (gap->lost != 0) {
        gap->incident = attribute(*stream, lossOf(*gap, gap->lost));
    }
}

/// Counts again the newest gaps of a stream, or only the one around a sample, which it returns.
const Gap* Attribution::recount(Stream& stream, std::optional<std::uint32_t> around) {
    std::size_t looked = 0;
    std::size_t own = 0;
    for (auto gap = m_gaps.rbegin(); gap != m_gaps.rend() && own < kMostBack && looked < kMostLooked;
         ++gap, ++looked) {
        own += gap->stream == stream.key ? 1 : 0;
        if (gap->stream == stream.key && (!around || gap->isAround(*around))) {
            recount(*gap, stream);
            if (around) {
                return &*gap;
            }
        }
    }
    return nullptr;
}

} // namespace posewire::model
