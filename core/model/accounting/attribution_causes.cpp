// SPDX-License-Identifier: MIT
#include "core/model/accounting/attribution.h"

#include <algorithm>
#include <array>
#include <cstdlib>

/// Whose loss a gap or the rest of a sample was: the evidence.
namespace posewire::model {
namespace {

// Other streams brought what is missing about when it should have come.
constexpr log::Duration kMeanwhile = std::chrono::milliseconds(150);
// One sample of a slow stream that is lost on its way looks like a pause.
constexpr std::uint32_t kFewestOfPause = 2;

} // namespace

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
    if (lost.isAny()) {
        return LossCause::ThisComputer;
    }
    return found->second.transport == log::Transport::Tcp ? LossCause::Sender : LossCause::Network;
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
    if (!hasPaused(gap, sender)) {
        return;
    }
    if (const Gap* cut = cutBeside(gap, sender)) {
        gap.otherType = cut->stream.type;
        decide(LossCause::Network, Gap::Evidence::CutOff,
               cut->isAround(gap.fromSample) ? gap.fromSample : gap.toSample);
    } else {
        decide(LossCause::Sender, Gap::Evidence::Paused, sender.streams.size());
    }
}

Attribution::LostHere Attribution::lostHere(std::uint64_t fromPacket, std::uint64_t toPacket,
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

const Attribution::Damage* Attribution::damageWithin(const Gap& gap) const {
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

bool Attribution::hasPaused(const Gap& gap, const Sender& sender) const {
    const log::Duration lasted = gap.toStamp - gap.fromStamp;
    if (gap.lost < kFewestOfPause) {
        return false;
    }
    const bool isSilent = std::ranges::any_of(sender.silences, [&](const TimeRange& silence) {
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
const Gap* Attribution::cutBeside(const Gap& gap, const Sender& sender) const {
    constexpr std::size_t kMostBeside = 512;
    const auto areNear = [](log::Stamp one, log::Stamp other) {
        return std::chrono::abs(one - other) < kMeanwhile;
    };
    const auto isOwed = [&](const Gap& other, std::uint32_t sample) {
        const auto stream =
            std::ranges::find(sender.streams, other.stream, [](const Stream* one) { return one->key; });
        return stream != sender.streams.end() &&
               (sample - other.fromSample) % std::max((*stream)->accounting.step(), 1U) == 0;
    };
    const std::size_t many = std::max<std::size_t>(2, sender.streams.size() / 5);
    std::array<const Gap*, 2> first{}; // that lacks the sample before, the one after
    std::array<std::size_t, 2> lacking{};
    std::size_t looked = 0;
    for (auto other = m_gaps.rbegin(); other != m_gaps.rend() && looked < kMostBeside; ++other, ++looked) {
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

} // namespace posewire::model
