// SPDX-License-Identifier: MIT
#include "core/model/accounting/loss_evidence.h"

#include "core/model/accounting/sample_window.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace posewire::model {
namespace {

// Other streams brought what is missing about when it should have come.
constexpr log::Duration kMeanwhile = std::chrono::milliseconds(150);
// One sample of a slow stream that is lost on its way looks like a pause.
constexpr std::uint32_t kFewestOfPause = 2;
// A shorter silence of a sender is no pause.
constexpr log::Duration kPause = std::chrono::milliseconds(250);
constexpr std::size_t kMostDrops = 4'096;
constexpr std::size_t kMostDamages = 1'024;
constexpr std::size_t kMostSilences = 64;
// A sender with more streams than these is no performance.
constexpr std::size_t kMostStreams = 64;

bool hasPaused(const Gap& gap, const std::deque<TimeRange>& silences) {
    const log::Duration lasted = gap.toStamp - gap.fromStamp;
    if (gap.lost < kFewestOfPause) {
        return false;
    }
    const bool isSilent = std::ranges::any_of(silences, [&](const TimeRange& silence) {
        const log::Duration common =
            std::min(silence.to, gap.toStamp) - std::max(silence.from, gap.fromStamp);
        return common >= kPause && 10 * common >= 9 * lasted;
    });
    const std::int64_t lastedMs = lasted / std::chrono::milliseconds(1);
    const std::int64_t moved = static_cast<std::int32_t>(gap.timeCodeMoved);
    return isSilent && std::abs(moved - lastedMs) <= std::max<std::int64_t>(50, lastedMs / 10);
}

/// A gap of another stream in the same silence that lacks the sample before or after this one, as many others
/// do: a sender that pauses sends its samples whole, and a few may have been lost by themselves. Null if
/// there is none.
const Gap* cutBeside(const Gap& gap, const std::vector<const Stream*>& streams, const std::deque<Gap>& gaps) {
    constexpr std::size_t kMostBeside = 512;
    const auto areNear = [](log::Stamp one, log::Stamp other) {
        return std::chrono::abs(one - other) < kMeanwhile;
    };
    const auto isOwed = [&](const Gap& other, std::uint32_t sample) {
        const auto stream =
            std::ranges::find(streams, other.stream, [](const Stream* one) { return one->key; });
        return stream != streams.end() &&
               (sample - other.fromSample) % std::max((*stream)->accounting.step(), 1U) == 0;
    };
    const std::size_t many = std::max<std::size_t>(2, streams.size() / 5);
    std::array<const Gap*, 2> first{}; // that lacks the sample before, the one after
    std::array<std::size_t, 2> lacking{};
    std::size_t looked = 0;
    for (auto other = gaps.rbegin(); other != gaps.rend() && looked < kMostBeside; ++other, ++looked) {
        const bool isBeside = other->stream.sender == gap.stream.sender && other->stream != gap.stream &&
                              other->lost != 0 && areNear(other->fromStamp, gap.fromStamp) &&
                              areNear(other->toStamp, gap.toStamp);
        for (const std::size_t edge : {0U, 1U}) {
            const std::uint32_t sample = edge == 0 ? gap.fromSample : gap.toSample;
            if (!isBeside || !other->isAround(sample) || !isOwed(*other, sample)) {
                continue;
            }
            first[edge] = first[edge] == nullptr ? &*other : first[edge];
            if (++lacking[edge] >= many) {
                return first[edge];
            }
        }
    }
    return nullptr;
}

} // namespace

void LossEvidence::addStream(const Stream& stream, const log::SenderInfo& info) {
    Sender& sender = m_senders[stream.key.sender];
    sender.transport = info.transport;
    sender.localPort = info.localPort;
    if (countsSamples(stream.key.type) && sender.streams.size() < kMostStreams) {
        sender.streams.push_back(&stream);
    }
}

void LossEvidence::takePacket(const log::Packet& packet, std::uint16_t localPort) {
    if (packet.kernelDropsBefore != 0) {
        keepNewest(m_drops, {packet.number, std::uint64_t{packet.kernelDropsBefore}, localPort}, kMostDrops);
    }
    if (packet.flags.afterClosed) {
        keepNewest(m_drops, {packet.number, 0, localPort, true}, kMostDrops);
    }
}

void LossEvidence::takeOvertaken(std::uint64_t packet, std::uint64_t count) {
    keepNewest(m_drops, {packet, count, std::nullopt}, kMostDrops);
}

void LossEvidence::takeSampled(log::SenderId sender, log::Stamp stamp) {
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

void LossEvidence::takeMalformed(const log::Packet& packet, const wire::Header& header) {
    keepNewest(m_damages,
               {{packet.sender, header.character, header.type()}, header.sampleCounter, packet.number},
               kMostDamages);
}

LossCause LossEvidence::causeOfPartial(const log::StreamKey& stream, std::uint64_t fromPacket,
                                       std::uint64_t toPacket) const {
    const auto found = m_senders.find(stream.sender);
    if (found == m_senders.end()) {
        return LossCause::Unknown;
    }
    // What was dropped just before the first part counts too: it may have been another part.
    const std::uint64_t before = fromPacket == 0 ? 0 : fromPacket - 1;
    const LostHere lost = lostHere(before, toPacket, found->second.localPort);
    if (lost.isAny()) {
        return LossCause::ThisComputer;
    }
    return found->second.transport == log::Transport::Tcp ? LossCause::Sender : LossCause::Network;
}

void LossEvidence::findCause(Gap& gap, const Stream& stream, const std::deque<Gap>& gaps) const {
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
    if (lost.isClosed) {
        return decide(LossCause::ThisComputer, Gap::Evidence::NotListening, 0);
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
    const TimeRange when{gap.fromStamp - kMeanwhile, gap.toStamp + kMeanwhile};
    const std::uint32_t step = stream.accounting.step(); // what others bring between is not missing here
    for (const Stream* other : sender.streams) {
        if (other->key == gap.stream) {
            continue;
        }
        if (const auto sample = other->accounting.arrivedBetween(gap.fromSample, gap.toSample, step, when)) {
            gap.otherType = other->key.type;
            return decide(LossCause::Network, Gap::Evidence::OtherStream, *sample);
        }
    }
    if (!hasPaused(gap, sender.silences)) {
        return;
    }
    if (const Gap* cut = cutBeside(gap, sender.streams, gaps)) {
        gap.otherType = cut->stream.type;
        decide(LossCause::Network, Gap::Evidence::CutOff,
               cut->isAround(gap.fromSample) ? gap.fromSample : gap.toSample);
    } else {
        decide(LossCause::Sender, Gap::Evidence::Paused, sender.streams.size());
    }
}

LossEvidence::LostHere LossEvidence::lostHere(std::uint64_t fromPacket, std::uint64_t toPacket,
                                              std::uint16_t localPort) const {
    LostHere lost;
    for (auto drop = m_drops.rbegin(); drop != m_drops.rend() && drop->packet > fromPacket; ++drop) {
        if (drop->packet <= toPacket && drop->localPort.value_or(localPort) == localPort) {
            (drop->localPort ? lost.dropped : lost.overtaken) += drop->count;
            lost.isClosed |= drop->isClosed;
        }
    }
    return lost;
}

const LossEvidence::Damage* LossEvidence::damageWithin(const Gap& gap) const {
    for (auto damage = m_damages.rbegin(); damage != m_damages.rend(); ++damage) {
        if (damage->packet < gap.fromPacket) {
            break;
        }
        if (damage->stream == gap.stream && gap.isAround(damage->sample)) {
            return &*damage;
        }
    }
    return nullptr;
}

bool Gap::isAround(std::uint32_t sample) const {
    return distance(sample, fromSample) > 0 && distance(toSample, sample) > 0;
}

words::Fact Gap::evidenceFact() const {
    using K = words::Kind;
    const auto lastedMs =
        words::Number{static_cast<double>((toStamp - fromStamp) / std::chrono::milliseconds(1))};
    const words::NamedValue sample{"sample", figure};
    const words::NamedValue type{"type", wire::typeDigits(otherType)};
    const words::NamedValue from{"from", fromPacket};
    const words::NamedValue to{"to", toPacket};
    const words::NamedValue samples{"samples", words::counted(K::Samples, lost)};
    switch (evidence) {
    case Evidence::Dropped:
        return {K::DroppedHere, {{"datagrams", words::counted(K::Datagrams, figure)}, from, to}};
    case Evidence::NotListening:
        return {K::NotListening};
    case Evidence::Overtaken:
        return {K::OvertakenBetween, {{"packets", words::counted(K::Packets, figure)}, from, to}};
    case Evidence::Damaged:
        return {K::SampleDamaged, {sample}};
    case Evidence::Partial:
        return {K::PartNextToGap, {sample}};
    case Evidence::OtherStream:
        return {K::OtherStream, {type, sample}};
    case Evidence::Reliable:
        return {K::NotSentByTcp, {samples}};
    case Evidence::CutOff:
        return {K::CutOff, {sample, type}};
    case Evidence::Paused:
        return {K::Paused,
                {{"streams", words::counted(K::Streams, figure)},
                 {"lasted", lastedMs},
                 {"moved", words::Number{static_cast<double>(timeCodeMoved)}}}};
    case Evidence::None:
        break;
    }
    return isJudged ? words::Fact{K::NoEvidence, {samples, {"lasted", lastedMs}}}
                    : words::Fact{K::WaitingForLate};
}

std::size_t LossEvidence::memoryBytes() const {
    std::size_t bytes = m_drops.size() * sizeof(Drop) + m_damages.size() * sizeof(Damage);
    for (const auto& [id, sender] : m_senders) {
        bytes += sizeof(Sender) + sender.silences.size() * sizeof(TimeRange) +
                 sender.streams.capacity() * sizeof(const Stream*);
    }
    return bytes;
}

} // namespace posewire::model
