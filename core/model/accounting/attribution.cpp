// SPDX-License-Identifier: MIT
#include "core/model/accounting/attribution.h"

#include "core/model/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cstdlib>

namespace posewire::model {
namespace {

constexpr std::size_t kMostDrops = 4'096;
constexpr std::size_t kMostDamages = 1'024;
constexpr std::size_t kMostSilences = 64;
// A sender with more streams than these is no performance.
constexpr std::size_t kMostStreams = 64;
// Late arrivals are looked for among this many gaps, or incomplete samples.
constexpr std::size_t kMostBack = 1'024;

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

void Attribution::addStream(std::size_t stream, const log::SenderInfo& info) {
    const log::StreamKey& key = m_streams[stream].key;
    Sender& sender = m_senders[key.sender];
    sender.transport = info.transport;
    sender.localPort = info.localPort;
    if (countsSamples(key.type) && sender.streams.size() < kMostStreams) {
        sender.streams.push_back(stream);
    }
    m_steps.resize(std::max(m_steps.size(), stream + 1));
    m_openPartials.resize(m_steps.size());
}

std::span<const Gap> Attribution::takePacket(const log::Packet& packet, std::uint16_t localPort) {
    m_judged.clear();
    while (!m_due.empty()) {
        Gap* gap = find(m_due.front().gap);
        if (gap != nullptr && packet.stamp - gap->toStamp < kPatience) {
            break;
        }
        if (gap != nullptr) {
            judge(*gap, m_due.front().stream);
            m_judged.push_back(*gap);
        }
        m_due.pop_front();
    }
    judgePartials(packet);
    if (packet.kernelDropsBefore != 0) {
        keepNewest(m_drops, {packet.number, packet.kernelDropsBefore, localPort}, kMostDrops);
    }
    return m_judged;
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

void Attribution::takeVerdict(std::size_t stream, const Verdict& verdict) {
    const std::uint32_t step = m_streams[stream].accounting.step();
    takePartial(stream, verdict);
    if (verdict.gap != 0) {
        m_gaps.push_back({.stream = m_streams[stream].key,
                          .fromSample = verdict.sampleBefore,
                          .toSample = verdict.sample,
                          .fromStamp = verdict.stampBefore,
                          .toStamp = verdict.stamp,
                          .fromPacket = verdict.packetBefore,
                          .toPacket = verdict.packet,
                          .lost = verdict.gap,
                          .timeCodeMoved = verdict.timeCode - verdict.timeCodeBefore});
        m_due.push_back({m_firstGap + m_gaps.size() - 1, stream});
        if (m_gaps.size() > kMostGaps) {
            m_gaps.pop_front();
            ++m_firstGap;
        }
    } else if (verdict.isReordered && verdict.isFirstOfSample) {
        recount(stream, verdict.sample); // it came after all
    }
    if (step != m_steps[stream]) {
        // Known in hindsight: what seemed lost may not be.
        m_steps[stream] = step;
        recount(stream, {});
    }
}

/// Notes what lacks a part, and what does not any more.
void Attribution::takePartial(std::size_t stream, const Verdict& verdict) {
    if (verdict.isAfterPartial) {
        const LossCause cause = causeOfPartial(m_streams[stream].key, verdict.packetBefore, verdict.packet);
        ++m_streams[stream].attributed[static_cast<std::size_t>(cause)];
    }
    std::uint64_t& open = m_openPartials[stream];
    if (verdict.isFirstOfSample && !verdict.isReordered && open > m_firstPartial) {
        m_partials[open - m_firstPartial - 1].nextPacket = verdict.packet;
        open = 0;
    }
    if (verdict.isFirstOfSample && !verdict.isCompleting) {
        m_partials.push_back({stream, verdict.sample, verdict.stamp, verdict.packet});
        open = verdict.isReordered ? open : m_firstPartial + m_partials.size();
    } else if (verdict.isCompleting && !verdict.isFirstOfSample) {
        complete(stream, verdict.sample);
    }
}

void Attribution::judgePartials(const log::Packet& packet) {
    for (; !m_partials.empty() && packet.stamp - m_partials.front().stamp >= kPatience;
         m_partials.pop_front(), ++m_firstPartial) {
        Partial& partial = m_partials.front();
        Stream& stream = m_streams[partial.stream];
        if (!stream.accounting.isIncomplete(partial.sample)) {
            continue;
        }
        const std::uint64_t to = partial.nextPacket != 0 ? partial.nextPacket : packet.number;
        partial.cause = causeOfPartial(stream.key, partial.packet, to);
        ++stream.attributed[static_cast<std::size_t>(partial.cause)];
        keepNewest(m_judgedPartials, partial, kMostBack);
    }
}

/// The missing part of a sample came after all.
void Attribution::complete(std::size_t stream, std::uint32_t sample) {
    const auto found = std::ranges::find_if(m_judgedPartials, [&](const Partial& partial) {
        return partial.stream == stream && partial.sample == sample;
    });
    if (found != m_judgedPartials.end()) {
        --m_streams[stream].attributed[static_cast<std::size_t>(found->cause)];
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
    if (dropsBetween(before, toPacket, found->second.localPort) != 0) {
        return LossCause::ThisComputer;
    }
    return found->second.transport == log::Transport::Tcp ? LossCause::Sender : LossCause::Network;
}

const Gap* Attribution::endedBy(std::uint64_t packet) const {
    const auto found = std::ranges::lower_bound(m_gaps, packet, {}, &Gap::toPacket);
    return found != m_gaps.end() && found->toPacket == packet ? &*found : nullptr;
}

/// Counts again what a gap still lacks, in it and in the sums of its stream.
void Attribution::recount(Gap& gap, std::size_t stream) {
    const std::uint32_t lost = m_streams[stream].accounting.missingBetween(gap.fromSample, gap.toSample);
    if (lost == gap.lost) {
        return;
    }
    if (gap.isJudged) {
        std::uint64_t& sum = m_streams[stream].attributed[static_cast<std::size_t>(gap.cause)];
        sum += lost;
        sum -= std::min<std::uint64_t>(sum, gap.lost);
    }
    gap.lost = lost;
}

void Attribution::judge(Gap& gap, std::size_t stream) {
    recount(gap, stream);
    findCause(gap, m_streams[stream]);
    gap.isJudged = true;
    m_streams[stream].attributed[static_cast<std::size_t>(gap.cause)] += gap.lost;
}

/// Counts again the newest gaps of a stream, or only the one around a sample.
void Attribution::recount(std::size_t stream, std::optional<std::uint32_t> around) {
    const log::StreamKey& key = m_streams[stream].key;
    std::size_t looked = 0;
    for (auto gap = m_gaps.rbegin(); gap != m_gaps.rend() && looked < kMostBack; ++gap, ++looked) {
        if (gap->stream == key && (!around || isBetween(*around, *gap))) {
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
    if (const std::uint64_t drops = dropsBetween(gap.fromPacket, gap.toPacket, sender.localPort);
        drops != 0) {
        return decide(LossCause::ThisComputer, Gap::Evidence::Dropped, drops);
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
    for (const std::size_t other : sender.streams) {
        const Stream& candidate = m_streams[other];
        if (candidate.key == gap.stream) {
            continue;
        }
        if (const auto sample = candidate.accounting.arrivedBetween(gap.fromSample, gap.toSample, when)) {
            gap.otherType = candidate.key.type;
            return decide(LossCause::Network, Gap::Evidence::OtherStream, *sample);
        }
    }
    if (hasPaused(gap, sender)) {
        decide(LossCause::Sender, Gap::Evidence::Paused, sender.streams.size());
    }
}

std::uint64_t Attribution::dropsBetween(std::uint64_t fromPacket, std::uint64_t toPacket,
                                        std::uint16_t localPort) const {
    std::uint64_t drops = 0;
    for (auto drop = m_drops.rbegin(); drop != m_drops.rend() && drop->packet > fromPacket; ++drop) {
        drops += drop->packet <= toPacket && drop->localPort == localPort ? drop->count : 0;
    }
    return drops;
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
