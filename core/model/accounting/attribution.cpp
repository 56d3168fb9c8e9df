// SPDX-License-Identifier: MIT
#include "core/model/accounting/attribution.h"

#include "core/model/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace posewire::model {
namespace {

constexpr std::size_t kMostDrops = 4'096;
constexpr std::size_t kMostDamages = 1'024;
// Where stamps stand still nothing becomes due.
constexpr std::size_t kMostPartials = 65'536;
constexpr std::size_t kMostSilences = 64;
// A sender with more streams than these is no performance.
constexpr std::size_t kMostStreams = 64;
// Late arrivals are looked for among this many gaps, or incomplete samples.
constexpr std::size_t kMostBack = 1'024;

// Datagrams of a stream after which nothing of it waits to be judged any longer.
std::uint64_t mostWaiting(const Stream& stream) {
    return stream.accounting.depth().samples / 4;
}

bool isBetween(std::uint32_t sample, const Gap& gap) {
    return distance(sample, gap.fromSample) > 0 && distance(gap.toSample, sample) > 0;
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

std::string Gap::evidenceText() const {
    const std::int64_t lastedMs = (toStamp - fromStamp) / std::chrono::milliseconds(1);
    switch (evidence) {
    case Evidence::Dropped:
        return "This computer dropped " + counted(figure, "datagram") + " of the port between packets " +
               std::to_string(fromPacket) + " and " + std::to_string(toPacket) + ".";
    case Evidence::Overtaken:
        return "This computer did not look at " + counted(figure, "packet") + " between packets " +
               std::to_string(fromPacket) + " and " + std::to_string(toPacket) + " in time.";
    case Evidence::Damaged:
        return "Sample " + std::to_string(figure) + " arrived truncated or damaged.";
    case Evidence::Partial:
        return "Of sample " + std::to_string(figure) + ", next to the gap, only a part arrived.";
    case Evidence::OtherStream:
        return "Type " + wire::typeDigits(otherType) + " of the same source brought sample " +
               std::to_string(figure) + ", which is missing here.";
    case Evidence::Reliable:
        return "TCP loses nothing: " + counted(lost, "sample was", "samples were") + " not sent.";
    case Evidence::Paused:
        return "All " + counted(figure, "stream") + " of the source paused together for " +
               std::to_string(lastedMs) + " ms, and the time code moved by " + std::to_string(timeCodeMoved) +
               " ms.";
    case Evidence::None:
        break;
    }
    return isJudged ? "Nothing was dropped here, and nothing else of the source shows where " +
                          counted(lost, "sample") + " went in " + std::to_string(lastedMs) + " ms."
                    : "Late arrivals are still waited for.";
}

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
    for (Due& due : m_due) {
        due.stream = due.stream != nullptr && due.stream->key.sender == sender ? nullptr : due.stream;
    }
    const auto isOf = [sender](const Partial& partial) { return partial.stream->key.sender == sender; };
    std::erase_if(m_judgedPartials, isOf);
    // Others know these by their place.
    for (Partial& partial : m_partials) {
        partial.stream = partial.stream != nullptr && isOf(partial) ? nullptr : partial.stream;
    }
}

std::span<const Gap> Attribution::takePacket(const log::Packet& packet, std::uint16_t localPort) {
    m_judged.clear();
    m_judged.swap(m_judgedEarly);
    while (!m_due.empty()) {
        Due& due = m_due.front();
        const Gap* gap = due.stream != nullptr ? find(due.gap) : nullptr;
        if (gap != nullptr && packet.stamp - gap->toStamp < kPatience) {
            break;
        }
        judge(due, m_judged);
        m_due.pop_front();
    }
    for (; !m_partials.empty() &&
           (m_partials.front().stream == nullptr || packet.stamp - m_partials.front().stamp >= kPatience ||
            m_partials.size() > kMostPartials);
         m_partials.pop_front(), ++m_firstPartial) {
        judge(m_partials.front(), packet.number);
    }
    if (packet.kernelDropsBefore != 0) {
        keepNewest(m_drops, {packet.number, std::uint64_t{packet.kernelDropsBefore}, localPort}, kMostDrops);
    }
    return m_judged;
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
    takePartial(stream, verdict);
    if (verdict.gap != 0) {
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
            m_gaps.pop_front();
            ++m_firstGap;
        }
    } else if (verdict.isReordered && verdict.isFirstOfSample) {
        recount(stream, verdict.sample); // it came after all
    }
    if (step != stream.judgedStep) {
        // Known in hindsight: what seemed lost may not be.
        stream.judgedStep = step;
        recount(stream, {});
    }
}

/// Notes what lacks a part, and what does not any more.
void Attribution::takePartial(Stream& stream, const Verdict& verdict) {
    if (verdict.isAfterPartial) {
        const LossCause cause = causeOfPartial(stream.key, verdict.packetBefore, verdict.packet);
        ++stream.attributed[static_cast<std::size_t>(cause)];
    }
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
    ++stream->attributed[static_cast<std::size_t>(partial.cause)];
    keepNewest(m_judgedPartials, partial, kMostBack);
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
    for (Due& due : m_due) {
        if (due.stream == &stream && !isWaiting(due.datagrams)) {
            judge(due, m_judgedEarly);
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
    const auto found = std::ranges::find_if(m_judgedPartials, [&](const Partial& partial) {
        return partial.stream == &stream && partial.sample == sample;
    });
    if (found != m_judgedPartials.end()) {
        --stream.attributed[static_cast<std::size_t>(found->cause)];
        m_judgedPartials.erase(found);
    }
}

/// Whose loss the rest of a sample or message is, of which some came from a packet on.
LossCause Attribution::causeOfPartial(const log::StreamKey& stream, std::uint64_t fromPacket,
                                      std::uint64_t toPacket) const {
    const auto found = m_senders.find(stream.sender);
    if (found == m_senders.end()) {
        return LossCause::Unknown;
    }
    // What was dropped just before the first part counts too: it may have been another part.
    const std::uint64_t before = fromPacket == 0 ? 0 : fromPacket - 1;
    const LostHere lost = lostHere(before, toPacket, found->second.localPort);
    if (lost.dropped + lost.overtaken != 0) {
        return LossCause::ThisComputer;
    }
    return found->second.transport == log::Transport::Tcp ? LossCause::Sender : LossCause::Network;
}

std::size_t Attribution::memoryBytes() const {
    std::size_t bytes = m_gaps.size() * sizeof(Gap) + m_due.size() * sizeof(Due) +
                        (m_partials.size() + m_judgedPartials.size()) * sizeof(Partial) +
                        m_drops.size() * sizeof(Drop) + m_damages.size() * sizeof(Damage) +
                        (m_judged.capacity() + m_judgedEarly.capacity()) * sizeof(Gap);
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

/// Counts again what a gap still lacks, in it and in the sums of its stream.
void Attribution::recount(Gap& gap, Stream& stream) {
    const std::uint32_t lost =
        stream.accounting.missingBetween(gap.fromSample, gap.toSample).value_or(gap.lost);
    if (lost == gap.lost) {
        return;
    }
    if (gap.isJudged) {
        std::uint64_t& sum = stream.attributed[static_cast<std::size_t>(gap.cause)];
        sum += lost;
        sum -= std::min<std::uint64_t>(sum, gap.lost);
    }
    gap.lost = lost;
}

/// Once; what it was is among `judged` then.
void Attribution::judge(Due& due, std::vector<Gap>& judged) {
    Stream* const stream = std::exchange(due.stream, nullptr);
    Gap* const gap = find(due.gap);
    if (stream == nullptr || gap == nullptr) {
        return;
    }
    recount(*gap, *stream);
    findCause(*gap, *stream);
    gap->isJudged = true;
    stream->attributed[static_cast<std::size_t>(gap->cause)] += gap->lost;
    judged.push_back(*gap);
}

/// Counts again the newest gaps of a stream, or only the one around a sample.
void Attribution::recount(Stream& stream, std::optional<std::uint32_t> around) {
    std::size_t looked = 0;
    for (auto gap = m_gaps.rbegin(); gap != m_gaps.rend() && looked < kMostBack; ++gap, ++looked) {
        if (gap->stream == stream.key && (!around || isBetween(*around, *gap))) {
            recount(*gap, stream);
            if (around) {
                return;
            }
        }
    }
}

void Attribution::findCause(Gap& gap, const Stream& stream) const {
    const auto found = m_senders.find(gap.stream.sender);
    if (gap.lost == 0 || found == m_senders.end()) {
        return;
    }
    const Sender& sender = found->second;
    const auto decide = [&](LossCause cause, Gap::Evidence evidence, std::uint64_t figure) {
        gap.cause = cause;
        gap.evidence = evidence;
        gap.figure = figure;
    };
    const LostHere lost = lostHere(gap.fromPacket, gap.toPacket, sender.localPort);
    if (lost.dropped != 0) {
        return decide(LossCause::ThisComputer, Gap::Evidence::Dropped, lost.dropped);
    }
    if (lost.overtaken != 0) {
        return decide(LossCause::ThisComputer, Gap::Evidence::Overtaken, lost.overtaken);
    }
    if (sender.transport == log::Transport::Tcp) {
        return decide(LossCause::Sender, Gap::Evidence::Reliable, 0);
    }
    if (const Damage* damage = damageWithin(gap)) {
        return decide(LossCause::Network, Gap::Evidence::Damaged, damage->sample);
    }
    for (const std::uint32_t neighbour : {gap.fromSample, gap.toSample}) {
        if (stream.accounting.isIncomplete(neighbour)) {
            return decide(LossCause::Network, Gap::Evidence::Partial, neighbour);
        }
    }
    const TimeRange when{gap.fromStamp - kPatience, gap.toStamp + kPatience};
    for (const Stream* other : sender.streams) {
        if (other->key == gap.stream) {
            continue;
        }
        if (const auto sample = other->accounting.arrivedBetween(gap.fromSample, gap.toSample, when)) {
            gap.otherType = other->key.type;
            return decide(LossCause::Network, Gap::Evidence::OtherStream, *sample);
        }
    }
    if (hasPaused(gap, sender)) {
        decide(LossCause::Sender, Gap::Evidence::Paused, sender.streams.size());
    }
}

Attribution::LostHere Attribution::lostHere(std::uint64_t fromPacket, std::uint64_t toPacket,
                                            std::uint16_t localPort) const {
    LostHere lost;
    for (auto drop = m_drops.rbegin(); drop != m_drops.rend() && drop->packet > fromPacket; ++drop) {
        if (drop->packet <= toPacket && drop->localPort.value_or(localPort) == localPort) {
            (drop->localPort ? lost.dropped : lost.overtaken) += drop->count;
        }
    }
    return lost;
}

const Attribution::Damage* Attribution::damageWithin(const Gap& gap) const {
    for (auto damage = m_damages.rbegin(); damage != m_damages.rend(); ++damage) {
        if (damage->packet < gap.fromPacket) {
            break;
        }
        if (damage->stream == gap.stream && isBetween(damage->sample, gap)) {
            return &*damage;
        }
    }
    return nullptr;
}

bool Attribution::hasPaused(const Gap& gap, const Sender& sender) const {
    const log::Duration lasted = gap.toStamp - gap.fromStamp;
    const bool isSilent = std::ranges::any_of(sender.silences, [&](const TimeRange& silence) {
        const log::Duration common =
            std::min(silence.to, gap.toStamp) - std::max(silence.from, gap.fromStamp);
        return common >= kPause && 10 * common >= 9 * lasted;
    });
    const std::int64_t lastedMs = lasted / std::chrono::milliseconds(1);
    const std::int64_t moved = static_cast<std::int32_t>(gap.timeCodeMoved);
    return isSilent && std::abs(moved - lastedMs) <= std::max<std::int64_t>(50, lastedMs / 10);
}

} // namespace posewire::model
