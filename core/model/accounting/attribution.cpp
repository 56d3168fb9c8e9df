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
constexpr std::size_t kMostDue = 65'536;
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
bool mayBeStep(const Gap& gap, const Stream& stream, log::Stamp stamp) {
    const bool isEven =
        gap.lost != 0 && stream.evenGaps != 0 && (gap.toSample - gap.fromSample) % stream.evenSpacing == 0;
    if (!isEven) {
        return false;
    }
    const log::Duration lasted = gap.toStamp - gap.fromStamp;
    const log::Duration patience = stream.evenGaps >= kEven ? std::max(kMostPatience, 3 * lasted)
                                                            : std::min(kMostPatience, 3 * lasted / 2);
    return stamp - stream.accounting.lastStamp() < patience;
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
    const auto isOf = [sender](const auto& one) {
        return one.stream != nullptr && one.stream->key.sender == sender;
    };
    std::erase_if(m_due, isOf);
    std::erase_if(m_judgedPartials, isOf);
    for (Partial& partial : m_partials) { // others know these by their place
        partial.stream = isOf(partial) ? nullptr : partial.stream;
    }
}

void Attribution::takePacket(const log::Packet& packet, const log::SenderInfo& from) {
    m_evidence.takePacket(packet, from); // first: it may be why something before it is due
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

/// By the packets up to one.
void Attribution::judgeDue(log::Stamp stamp, std::uint64_t packet, bool isAll) {
    if (m_lateSeen && stamp - *m_lateSeen > kForgetLate) {
        m_patience = kPatience;
        m_lateSeen.reset();
    }
    while (!m_due.empty() && (isAll || m_due.front().at <= stamp || m_due.size() > kMostDue)) {
        const bool isNow = isAll || m_due.size() > kMostDue;
        Due due = m_due.front();
        m_due.pop_front();
        if (due.what == Due::What::Gap && due.stream != nullptr && !isNow) {
            const Gap& gap = m_gaps[due.number - m_firstGap];
            due.at = gap.toStamp + m_patience;
            if (due.at <= stamp && mayBeStep(gap, *due.stream, stamp)) {
                due.at = stamp + kHeldCheck;
            }
        }
        if (due.at > stamp && !isNow) {
            expect(due);
        } else {
            judge(due, packet);
        }
    }
}

void Attribution::expect(const Due& due) {
    m_due.insert(std::ranges::upper_bound(m_due, due.at, {}, &Due::at), due);
}

/// By the packets up to one.
void Attribution::judge(Due& due, std::uint64_t packet) {
    Stream* const stream = std::exchange(due.stream, nullptr);
    if (stream == nullptr) {
        return;
    }
    switch (due.what) {
    case Due::What::Gap: {
        Gap& gap = m_gaps[due.number - m_firstGap];
        recount(gap, *stream, {});
        gap.isJudged = true;
        if (gap.lost != 0) {
            report(*m_sink, gap, *stream, m_evidence.findCauses(gap, *stream));
        }
        break;
    }
    case Due::What::Partial:
        judge(m_partials[due.number - m_firstPartial], packet);
        break;
    case Due::What::Rest:
        stream->awaitsRest = false;
        attributeRest(*stream);
        break;
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
            expectPartial(stream, verdict, MessageRounds::kTogether + log::Duration(1));
        }
    }
    bool mayBeRest = false;
    if (verdict.gap != 0 || verdict.mayBeGap) {
        m_gaps.push_back({.stream = stream.key,
                          .fromSample = verdict.sampleBefore,
                          .toSample = verdict.sample,
                          .fromStamp = verdict.stampBefore,
                          .toStamp = verdict.stamp,
                          .fromPacket = verdict.packetBefore,
                          .toPacket = verdict.packet,
                          .lost = verdict.gap});
        expect({Due::What::Gap, &stream, verdict.stamp + m_patience, m_firstGap + m_gaps.size() - 1,
                stream.accounting.datagrams()});
        expectJudgement(stream);
        if (m_gaps.size() > kMostGaps) {
            forgetGap();
        }
    } else if (verdict.isReordered && verdict.isFirstOfSample) {
        if (const Gap* gap = recount(stream, verdict.sample)) { // it came after all
            const log::Duration late = verdict.stamp - gap->toStamp;
            m_patience = gap->isJudged ? std::clamp(late + late / 2, m_patience, kMostPatience) : m_patience;
            m_lateSeen = gap->isJudged ? verdict.stamp : m_lateSeen;
        } else {
            mayBeRest = true; // it may be from before the first one
        }
    }
    if (step != stream.judgedStep) {
        // Known in hindsight: what seemed lost may not be.
        stream.judgedStep = step;
        recount(stream, {});
        mayBeRest = true;
    }
    if (mayBeRest && !std::exchange(stream.awaitsRest, true)) {
        expect({Due::What::Rest, &stream, verdict.stamp + m_patience});
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
        expectPartial(stream, verdict, kPatience);
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

void Attribution::expectPartial(Stream& stream, const Verdict& verdict, log::Duration patience) {
    m_partials.push_back({&stream, verdict.sample, verdict.stamp, verdict.packet});
    expect({Due::What::Partial, &stream, verdict.stamp + patience, m_firstPartial + m_partials.size() - 1,
            stream.accounting.datagrams()});
}

/// By the packets up to one.
void Attribution::judge(Partial& partial, std::uint64_t packet) {
    const StreamAccounting& accounting = partial.stream->accounting;
    if (!countsSamples(partial.stream->key.type)) {
        if (accounting.partialMessage() == partial.packet) { // nothing more comes of it
            partial.stream->judgedMessage = partial.packet;
            lose(partial, packet, packet, {words::Kind::PartOfMessage});
        }
    } else if (accounting.isIncomplete(partial.sample)) {
        lose(partial, partial.nextPacket != 0 ? partial.nextPacket : packet, partial.packet,
             {words::Kind::PartOfSample, {{"sample", words::Number{static_cast<double>(partial.sample)}}}});
    }
    partial.stream = nullptr;
    for (; !m_partials.empty() && m_partials.front().stream == nullptr; m_partials.pop_front()) {
        ++m_firstPartial;
    }
}

void Attribution::lose(const Partial& partial, std::uint64_t lastPacket, std::uint64_t toPacket,
                       words::Fact evidence) {
    Stream& stream = *partial.stream;
    Partial lost = partial;
    lost.cause = stream.accounting.framing().isShort(partial.sample)
                     ? LossCause::Sender
                     : m_evidence.causeOfPartial(stream.key, partial.packet, lastPacket);
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
    for (Due& due : m_due) {
        if (due.stream == &stream && due.what != Due::What::Rest && !isWaiting(due.datagrams)) {
            judge(due, packet);
        }
    }
}

std::size_t Attribution::memoryBytes() const {
    return m_gaps.size() * sizeof(Gap) + m_due.size() * sizeof(Due) +
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
    std::uint64_t told =
        std::accumulate(stream.attributed.begin(), stream.attributed.end(), std::uint64_t{0});
    forEachWaiting([&](const Gap& gap) { told += gap.stream == stream.key ? gap.lost : 0; });
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

/// The oldest one, which is judged at the latest now.
void Attribution::forgetGap() {
    const auto isOldest = [this](const Due& due) {
        return due.what == Due::What::Gap && due.number == m_firstGap;
    };
    if (!m_gaps.front().isJudged) {
        if (const auto due = std::ranges::find_if(m_due, isOldest); due != m_due.end()) {
            judge(*due, m_lastPacket);
        }
    }
    m_gaps.pop_front();
    ++m_firstGap;
}

} // namespace posewire::model
