// SPDX-License-Identifier: MIT
#include "core/model/accounting/attribution.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace posewire::model {
namespace {

// After samples that came later than that, more is waited for; for as long.
constexpr log::Duration kMostPatience = std::chrono::seconds(2);
constexpr log::Duration kForgetLate = std::chrono::seconds(30);
// Where stamps freeze nothing becomes due.
constexpr std::size_t kMostPartials = 65'536;
// Late arrivals are looked for among this many gaps of a stream, or incomplete samples, and not farther back
// than that many gaps of all.
constexpr std::size_t kMostBack = 1'024;
constexpr std::size_t kMostLooked = 8'192;
// Judged partials that are remembered: those of a range of time are looked up among them.
constexpr std::size_t kMostJudged = 16'384;
// So many equal gaps in a row may be the spacing of a new rate.
constexpr std::uint32_t kEven = 3;
constexpr log::Duration kHeldCheck = std::chrono::milliseconds(50);

// Datagrams of a stream after which nothing of it waits to be judged any longer.
std::uint64_t mostWaiting(const Stream& stream) {
    return stream.accounting.depth().samples / 4;
}

/// Gaps in a row that are all multiples of one spacing may be a new step of the sender, losses among them.
void noteSpacing(Stream& stream, const Verdict& verdict) {
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
bool mayBeStep(const Gap& gap, log::Stamp stamp) {
    const Stream* stream = gap.waiting;
    const bool isEven = stream != nullptr && gap.lost != 0 && stream->evenGaps != 0 &&
                        (gap.toSample - gap.fromSample) % stream->evenSpacing == 0;
    if (!isEven) {
        return false;
    }
    const log::Duration lasted = gap.toStamp - gap.fromStamp;
    const log::Duration patience = stream->evenGaps >= kEven ? std::max(kMostPatience, 3 * lasted)
                                                             : std::min(kMostPatience, 3 * lasted / 2);
    return stamp - stream->accounting.lastStamp() < patience;
}

/// Counts a loss and reports it. Returns its incident.
std::uint64_t attribute(LossSink& sink, Stream& stream, Loss loss) {
    stream.attributed[static_cast<std::size_t>(loss.cause)] += loss.samples;
    return sink.takeLoss(std::move(loss));
}

/// Reports what was lost of a gap by each cause.
void report(LossSink& sink, Gap& gap, Stream& stream, std::span<const LossEvidence::Run> runs) {
    // The most first: a silence has the cause of what was lost in it, not of what was beside it.
    const LossCause main = gap.mainCause();
    for (const bool isMain : {true, false}) {
        for (const LossEvidence::Run& run : runs) {
            if ((run.cause == main) == isMain) {
                Gap::Share& share = gap.of(run.cause);
                share.incident = attribute(sink, stream,
                                           {.stream = gap.stream,
                                            .cause = run.cause,
                                            .samples = run.lost,
                                            .from = run.from,
                                            .to = run.to,
                                            .fromPacket = gap.fromPacket,
                                            .toPacket = gap.toPacket,
                                            .incident = share.incident,
                                            .evidence = gap.evidenceFact(run.cause)});
            }
        }
    }
}

void takeBack(LossSink& sink, Gap& gap, Stream& stream, LossCause cause, std::uint32_t samples) {
    Gap::Share& share = gap.of(cause);
    share.lost -= std::min(share.lost, samples);
    std::uint64_t& sum = stream.attributed[static_cast<std::size_t>(cause)];
    const std::uint64_t less = std::min<std::uint64_t>(sum, samples);
    sum -= less;
    sink.takeBack(share.incident, gap.stream, less, share.lost == 0);
}

} // namespace

void Attribution::retire(log::SenderId sender) {
    m_evidence.retire(sender);
    const std::uint64_t end = m_firstGap + m_gaps.size();
    for (std::uint64_t number = m_held.empty() ? m_firstDue : m_held.front(); number < end; ++number) {
        Gap& gap = m_gaps[number - m_firstGap];
        gap.waiting = gap.stream.sender == sender ? nullptr : gap.waiting;
    }
    const auto isOf = [sender](const auto& one) {
        return one.stream != nullptr && one.stream->key.sender == sender;
    };
    std::erase_if(m_open, isOf);
    std::erase_if(m_rests, isOf);
    std::erase_if(m_judgedPartials, isOf);
    // Others know these by their place.
    for (Partial& partial : m_partials) {
        partial.stream = isOf(partial) ? nullptr : partial.stream;
    }
}

void Attribution::takePacket(const log::Packet& packet, std::uint16_t localPort) {
    m_evidence.takePacket(packet, localPort); // first: it may be why something before it is due
    judgeDue(packet.stamp, packet.number);
    m_lastPacket = packet.number;
}

/// A stream remembers only its newest samples: by then at the latest.
void Attribution::expectJudgement(Stream& stream) {
    stream.judgeAt = std::min(stream.judgeAt, stream.accounting.datagrams() + mostWaiting(stream));
}

const Gap* Attribution::endedBy(std::uint64_t packet) const {
    const auto found = std::ranges::lower_bound(m_gaps, packet, {}, &Gap::toPacket);
    return found != m_gaps.end() && found->toPacket == packet ? &*found : nullptr;
}

/// Counts again what a gap still lacks, in it and in the sums of its stream; `late`: the sample that came.
void Attribution::recount(Gap& gap, Stream& stream, std::optional<std::uint32_t> late) {
    const std::uint32_t lost =
        stream.accounting.missingBetween(gap.fromSample, gap.toSample).value_or(gap.lost);
    const std::uint32_t before = std::exchange(gap.lost, lost);
    if (lost != before) {
        m_recounts.push_back({gap.toPacket, lost});
    }
    if (!gap.isJudged || lost == before) {
        return;
    }
    if (lost > before) {
        const LossCause cause = before != 0 ? gap.mainCause() : LossCause::Unknown;
        gap.of(cause).lost += lost - before;
        const LossEvidence::Run run{cause, lost - before, gap.fromStamp, gap.toStamp};
        report(*m_sink, gap, stream, std::span(&run, 1));
        return;
    }
    std::uint32_t less = before - lost;
    if (late && less == 1) {
        const LossCause cause = m_evidence.causeOf(gap, stream, *late);
        takeBack(*m_sink, gap, stream, gap.of(cause).lost != 0 ? cause : gap.mainCause(), 1);
        return;
    }
    while (less != 0) {
        const LossCause cause = gap.mainCause();
        const std::uint32_t some = std::min(less, gap.of(cause).lost);
        if (some == 0) {
            break;
        }
        takeBack(*m_sink, gap, stream, cause, some);
        less -= some;
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
            recount(*gap, stream, around);
            if (around) {
                return &*gap;
            }
        }
    }
    return nullptr;
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
    for (; m_firstDue < m_firstGap + m_gaps.size(); ++m_firstDue) {
        Gap& gap = m_gaps[m_firstDue - m_firstGap];
        if (!isAll && gap.waiting != nullptr && stamp - gap.toStamp < m_patience) {
            break;
        }
        if (!isAll && mayBeStep(gap, stamp)) {
            m_held.push_back(m_firstDue);
        } else {
            judge(gap);
        }
    }
    if (isAll || stamp >= m_nextHeld) {
        m_nextHeld = stamp + kHeldCheck;
        std::erase_if(m_held, [&](std::uint64_t number) {
            Gap& gap = m_gaps[number - m_firstGap];
            const bool isOver = isAll || !mayBeStep(gap, stamp);
            if (isOver) {
                judge(gap);
            }
            return isOver;
        });
    }
    for (; !m_open.empty() && (isAll || stamp - m_open.front().stamp > MessageRounds::kTogether ||
                               m_open.size() > kMostPartials);
         m_open.pop_front()) {
        const OpenMessage& message = m_open.front();
        if (message.stream->accounting.partialMessage() == message.packet) { // nothing more comes of it
            message.stream->judgedMessage = message.packet;
            lose({message.stream, 0, message.stamp, message.packet}, packet, packet,
                 {words::Kind::PartOfMessage});
        }
    }
    for (; !m_partials.empty() &&
           (isAll || m_partials.front().stream == nullptr || stamp - m_partials.front().stamp >= kPatience ||
            m_partials.size() > kMostPartials);
         m_partials.pop_front(), ++m_firstPartial) {
        judge(m_partials.front(), packet);
    }
    for (; !m_rests.empty() && (isAll || stamp - m_rests.front().stamp >= m_patience); m_rests.pop_front()) {
        m_rests.front().stream->awaitsRest = false;
        attributeRest(*m_rests.front().stream);
    }
}

void Attribution::takeVerdict(Stream& stream, const Verdict& verdict) {
    const std::uint32_t step = stream.accounting.step();
    if (stream.accounting.datagrams() >= stream.judgeAt) {
        judgeEarly(stream, verdict.packet);
    }
    noteSpacing(stream, verdict);
    if (countsSamples(stream.key.type)) {
        takePartial(stream, verdict);
    } else {
        if (verdict.isAfterPartial && stream.judgedMessage != verdict.packetBefore) {
            lose({&stream, 0, verdict.stamp, verdict.packetBefore}, verdict.packet, verdict.packet,
                 {words::Kind::PartOfMessage});
        }
        if (stream.accounting.partialMessage() == verdict.packet) {
            m_open.push_back({&stream, verdict.stamp, verdict.packet});
        }
    }
    if (verdict.gap != 0 || verdict.mayBeGap) {
        m_gaps.push_back({.stream = stream.key,
                          .fromSample = verdict.sampleBefore,
                          .toSample = verdict.sample,
                          .fromStamp = verdict.stampBefore,
                          .toStamp = verdict.stamp,
                          .fromPacket = verdict.packetBefore,
                          .toPacket = verdict.packet,
                          .lost = verdict.gap,
                          .waiting = &stream,
                          .datagrams = stream.accounting.datagrams()});
        expectJudgement(stream);
        if (m_gaps.size() > kMostGaps) {
            judge(m_gaps.front());
            if (!m_held.empty() && m_held.front() == m_firstGap) {
                m_held.pop_front();
            }
            m_firstDue = std::max(m_firstDue, m_firstGap + 1);
            m_gaps.pop_front();
            ++m_firstGap;
        }
    } else if (verdict.isReordered && verdict.isFirstOfSample) {
        if (const Gap* gap = recount(stream, verdict.sample)) { // it came after all
            const log::Duration late = verdict.stamp - gap->toStamp;
            m_patience = gap->isJudged ? std::clamp(late + late / 2, m_patience, kMostPatience) : m_patience;
            m_lateSeen = gap->isJudged ? verdict.stamp : m_lateSeen;
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
        // The missing part of a sample came after all.
        const auto newest = m_judgedPartials.end();
        const auto oldest =
            newest - static_cast<std::ptrdiff_t>(std::min(kMostBack, m_judgedPartials.size()));
        const auto found = std::find_if(oldest, newest, [&](const Partial& partial) {
            return partial.stream == &stream && partial.sample == verdict.sample;
        });
        if (found != newest) {
            --stream.attributed[static_cast<std::size_t>(found->cause)];
            m_sink->takeBack(found->incident, stream.key, 1, true);
            m_judgedPartials.erase(found);
        }
    }
}

/// By the packets up to one.
void Attribution::judge(Partial& partial, std::uint64_t packet) {
    if (partial.stream != nullptr && partial.stream->accounting.isIncomplete(partial.sample)) {
        lose(partial, partial.nextPacket != 0 ? partial.nextPacket : packet, partial.packet,
             {words::Kind::PartOfSample, {{"sample", words::Number{static_cast<double>(partial.sample)}}}});
    }
    partial.stream = nullptr;
}

void Attribution::lose(const Partial& partial, std::uint64_t lastPacket, std::uint64_t toPacket,
                       words::Fact evidence) {
    Stream& stream = *partial.stream;
    Partial lost = partial;
    lost.cause = m_evidence.causeOfPartial(stream.key, partial.packet, lastPacket);
    lost.incident = attribute(*m_sink, stream,
                              {.stream = stream.key,
                               .cause = lost.cause,
                               .samples = 1,
                               .from = partial.stamp,
                               .to = partial.stamp,
                               .fromPacket = partial.packet,
                               .toPacket = toPacket,
                               .evidence = std::move(evidence)});
    keepNewest(m_judgedPartials, lost, kMostJudged);
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
    const std::uint64_t first = m_held.empty() ? m_firstDue : m_held.front();
    for (auto gap = m_gaps.begin() + static_cast<std::ptrdiff_t>(first - m_firstGap); gap != m_gaps.end();
         ++gap) {
        if (gap->waiting == &stream && !isWaiting(gap->datagrams)) {
            judge(*gap);
        }
    }
    for (Partial& partial : m_partials) {
        if (partial.stream == &stream && !isWaiting(partial.datagrams)) {
            judge(partial, packet);
        }
    }
}

std::size_t Attribution::memoryBytes() const {
    return m_gaps.size() * sizeof(Gap) + m_held.size() * sizeof(m_held[0]) +
           m_open.size() * sizeof(OpenMessage) +
           (m_partials.size() + m_judgedPartials.size()) * sizeof(Partial) + m_evidence.memoryBytes();
}

std::uint64_t Attribution::firstPending(log::Stamp after) const {
    std::uint64_t first = UINT64_MAX;
    forEachWaiting(
        [&](const Gap& gap) { first = gap.toStamp > after ? std::min(first, gap.toPacket) : first; });
    return first;
}

/// Samples from before the step was known: in hindsight they are lost, or are not, and no gap was seen.
void Attribution::attributeRest(Stream& stream) {
    const StreamCounts counts = stream.accounting.counts();
    std::uint64_t told = 0;
    for (const std::uint64_t samples : stream.attributed) {
        told += samples;
    }
    forEachWaiting([&](const Gap& gap) { told += gap.waiting == &stream ? gap.lost : 0; });
    for (const Partial& partial : m_partials) {
        told += partial.stream == &stream && stream.accounting.isIncomplete(partial.sample) ? 1 : 0;
    }
    const std::uint64_t missing = counts.lost + counts.incomplete;
    if (missing > told) {
        stream.restIncident = attribute(*m_sink, stream,
                                        {.stream = stream.key,
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

/// Once.
void Attribution::judge(Gap& gap) {
    Stream* const stream = std::exchange(gap.waiting, nullptr);
    if (stream == nullptr) {
        return;
    }
    recount(gap, *stream, {});
    gap.isJudged = true;
    if (gap.lost != 0) {
        report(*m_sink, gap, *stream, m_evidence.findCauses(gap, *stream));
    }
}

} // namespace posewire::model
