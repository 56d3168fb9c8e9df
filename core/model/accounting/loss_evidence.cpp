// SPDX-License-Identifier: MIT
#include "core/model/accounting/loss_evidence.h"

#include "core/log/ip_packet.h"
#include "core/model/accounting/sample_window.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <utility>

namespace posewire::model {
namespace {

// Other streams brought what is missing about when it should have come.
constexpr log::Duration kMeanwhile = std::chrono::milliseconds(150);
// A shorter silence of a host is no pause; nor is one of fewer periods of its fastest stream: three samples.
constexpr log::Duration kPause = std::chrono::milliseconds(50);
constexpr double kPeriodsOfPause = 3.5;
// The shortest pause of a host whose rate is not known yet.
constexpr log::Duration kPauseAtFirst = std::chrono::milliseconds(250);
// Hosts fall silent together if they do within this time, and a period of the slower one.
constexpr log::Duration kTogether = std::chrono::milliseconds(50);
// If the samples of a gap are further apart than this, the sender's counter stopped during the silence.
constexpr double kMostPeriodsApart = 3;
constexpr std::size_t kMostDrops = 4'096;
constexpr std::size_t kMostDamages = 1'024;
constexpr std::size_t kMostSilences = 64;
// A sender with more streams than these is no performance.
constexpr std::size_t kMostStreams = 64;
// Longer gaps are judged as if they were so long, and of more runs the last ones are one.
constexpr std::size_t kMostSamples = 65'536;
constexpr std::size_t kMostRuns = 64;

} // namespace

void LossEvidence::addStream(const Stream& stream, const log::SenderInfo& info) {
    const auto [place, isNew] = m_senders.try_emplace(stream.key.sender);
    Sender& sender = place->second;
    if (isNew) {
        sender.transport = info.transport;
        sender.port = info.port();
        sender.host = m_hosts.try_emplace(info.probe + '/' + std::string(log::hostOf(info.address))).first;
        ++sender.host->second.senders;
    }
    if (countsSamples(stream.key.type)) {
        ++sender.host->second.streams;
        if (sender.streams.size() < kMostStreams) {
            sender.streams.push_back(&stream);
        }
    }
}

void LossEvidence::retire(log::SenderId sender) {
    const auto found = m_senders.find(sender);
    if (found != m_senders.end()) {
        if (--found->second.host->second.senders == 0) {
            m_hosts.erase(found->second.host);
        }
        m_senders.erase(found);
    }
}

void LossEvidence::takePacket(const log::Packet& packet, const log::SenderInfo& from) {
    using enum Gap::Evidence;
    if (packet.kernelDropsBefore != 0) {
        keepNewest(m_drops,
                   {packet.number, packet.stamp, packet.kernelDropsBefore,
                    packet.flags.isLostOnWay ? OnWay : Dropped, from.port()},
                   kMostDrops);
    }
    if (packet.flags.afterClosed) {
        keepNewest(m_drops, {packet.number, packet.stamp, 0, NotListening, from.port()}, kMostDrops);
    }
    if (packet.flags.dropsUncounted) {
        if (const auto found = m_senders.find(packet.sender); found != m_senders.end()) {
            found->second.hasUncountedDrops = true;
        }
    }
}

void LossEvidence::takeOvertaken(std::uint64_t packet, std::uint64_t count, log::Stamp stamp) {
    keepNewest(m_drops, {packet, stamp, count, Gap::Evidence::Overtaken}, kMostDrops);
}

template <class Visit>
void LossEvidence::forEachDrop(std::uint64_t fromPacket, std::uint64_t toPacket,
                               const log::ReceivingPort& port, const Visit& visit) const {
    for (auto drop = m_drops.rbegin(); drop != m_drops.rend() && drop->packet > fromPacket; ++drop) {
        const bool isOfAll = drop->evidence == Gap::Evidence::Overtaken ||
                             (drop->evidence == Gap::Evidence::OnWay && drop->port.probe == port.probe);
        if (drop->packet <= toPacket && (isOfAll || drop->port == port)) {
            visit(*drop);
        }
    }
}

void LossEvidence::takeSampled(log::SenderId sender, log::Stamp stamp, std::uint32_t sample) {
    constexpr std::int32_t kRestart = -100; // the counter is back by more than that
    const auto found = m_senders.find(sender);
    if (found == m_senders.end()) {
        return;
    }
    const std::int32_t ahead = distance(sample, found->second.newest);
    if (ahead <= 0 && ahead >= kRestart) {
        return;
    }
    found->second.newest = sample;
    Host& host = found->second.host->second;
    const log::Stamp before = std::exchange(host.lastStamp, std::max(host.lastStamp, stamp));
    if (before == log::Stamp() || stamp - before < kPause) {
        return;
    }
    const log::Duration period = periodOf(host);
    const log::Duration least = period > log::Duration::zero()
                                    ? std::chrono::duration_cast<log::Duration>(kPeriodsOfPause * period)
                                    : kPauseAtFirst;
    if (stamp - before >= least) {
        keepNewest(host.silences, {{before, stamp}, period}, kMostSilences);
    }
}

/// Of the fastest stream; 0 if that is not known.
log::Duration LossEvidence::periodOf(const Host& host) const {
    double fastestHz = 0;
    for (const auto& [id, sender] : m_senders) {
        if (&sender.host->second == &host) {
            for (const Stream* stream : sender.streams) {
                fastestHz = std::max(fastestHz, stream->statistics.rateHz());
            }
        }
    }
    return fastestHz > 0 ? log::durationOf(1 / fastestHz) : log::Duration::zero();
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
    std::optional<LossCause> lost;
    forEachDrop(before, toPacket, found->second.port, [&lost](const Drop& drop) {
        const bool isOnWay = drop.evidence == Gap::Evidence::OnWay;
        lost = isOnWay ? lost.value_or(LossCause::Transport) : LossCause::ThisComputer;
    });
    if (lost) {
        return *lost;
    }
    if (found->second.hasUncountedDrops) {
        return LossCause::Unknown;
    }
    return found->second.transport == log::Transport::Tcp ? LossCause::Sender : LossCause::Network;
}

std::span<const LossEvidence::Run> LossEvidence::findCauses(Gap& gap, const Stream& stream) {
    judgeSamples(gap, stream, {});
    gap.shares = {};
    m_runs.clear();
    std::uint32_t left = gap.lost; // what came of them is known only while it is remembered
    for (std::size_t place = 0; m_isAnyJudged && place < m_missing.size() && left != 0; ++place) {
        const Missing& missing = m_missing[place];
        if (!missing.isMissing) {
            continue;
        }
        const LossCause cause = missing.cause.value_or(LossCause::Unknown);
        Gap::Share& share = gap.of(cause);
        if (share.lost == 0) {
            share = {0, missing.otherType, missing.evidence, missing.figure, 0};
        }
        if (m_runs.empty() || (m_runs.back().cause != cause && m_runs.size() < kMostRuns)) {
            const log::Stamp from = m_runs.empty() ? gap.fromStamp : dueAt(place - 1, gap);
            if (!m_runs.empty()) {
                m_runs.back().to = dueAt(place, gap);
            }
            m_runs.push_back({cause, 0, from, gap.toStamp});
        }
        Run& run = m_runs.back();
        ++run.lost;
        ++gap.of(run.cause).lost;
        --left;
    }
    if (left != 0) {
        m_runs.push_back(
            {m_runs.empty() ? LossCause::Unknown : m_runs.back().cause, left, gap.fromStamp, gap.toStamp});
        gap.of(m_runs.back().cause).lost += left;
    }
    return m_runs;
}

LossCause LossEvidence::causeOf(const Gap& gap, const Stream& stream, std::uint32_t sample) {
    judgeSamples(gap, stream, sample);
    const auto place = placeOf(sample, gap);
    return place && *place < m_missing.size() ? m_missing[*place].cause.value_or(LossCause::Unknown)
                                              : LossCause::Unknown;
}

void LossEvidence::judgeSamples(const Gap& gap, const Stream& stream, std::optional<std::uint32_t> late) {
    m_step = std::max(stream.accounting.stepAt(gap.fromSample), 1U);
    const std::size_t samples = (gap.toSample - gap.fromSample - 1) / m_step;
    m_missing.assign(std::min(samples, kMostSamples), {});
    const double apartS =
        log::secondsOf(gap.toStamp - gap.fromStamp) / static_cast<double>(m_missing.size() + 1);
    m_isCounterStopped = apartS * stream.statistics.rateHz() > kMostPeriodsApart;
    m_isAnyJudged = false;
    const auto found = m_senders.find(gap.stream.sender);
    if (found == m_senders.end()) {
        return;
    }
    const Sender& sender = found->second;
    stream.accounting.forEachBetween(
        gap.fromSample, gap.toSample, [&](std::uint32_t sample, log::Stamp stamp) {
            const auto place = placeOf(sample, gap);
            if (place && sample != late && stamp >= gap.fromStamp) { // else it is of before a restart
                m_missing[*place].isMissing = false;
            }
        });
    judgeLostHere(gap, sender.port);
    if (sender.transport == log::Transport::Tcp) {
        judgeRest({.cause = LossCause::Sender, .evidence = Gap::Evidence::Reliable});
        return;
    }
    for (auto damage = m_damages.rbegin(); damage != m_damages.rend() && damage->packet >= gap.fromPacket;
         ++damage) {
        if (const auto place = placeOf(damage->sample, gap); place && damage->stream == gap.stream) {
            judge(
                *place,
                {.cause = LossCause::Network, .evidence = Gap::Evidence::Damaged, .figure = damage->sample});
        }
    }
    if (sender.hasUncountedDrops) { // it may have been this computer whatever else is seen
        judgeRest({.cause = LossCause::Unknown, .evidence = Gap::Evidence::Uncounted});
        return;
    }
    judgeBrought(gap, sender);
    judgeSilent(gap, sender.host->second);
}

void LossEvidence::judge(std::size_t place, const Missing& as) {
    if (Missing& missing = m_missing[place]; missing.isMissing && !missing.cause) {
        missing = as;
        m_isAnyJudged = true;
    }
}

void LossEvidence::judgeRest(const Missing& as) {
    for (std::size_t place = 0; place < m_missing.size(); ++place) {
        judge(place, as);
    }
}

/// Nothing if none of that number is expected in the gap.
std::optional<std::size_t> LossEvidence::placeOf(std::uint32_t sample, const Gap& gap) const {
    const std::uint32_t after = sample - gap.fromSample;
    const bool isExpected = gap.isAround(sample) && after % m_step == 0;
    const std::size_t place = after / m_step - 1;
    return isExpected && place < m_missing.size() ? std::optional(place) : std::nullopt;
}

/// When a sample should have come, if those of the gap were as far apart.
log::Stamp LossEvidence::dueAt(std::size_t place, const Gap& gap) const {
    const double share = static_cast<double>(place + 1) / static_cast<double>(m_missing.size() + 1);
    return gap.fromStamp + log::durationOf(share * log::secondsOf(gap.toStamp - gap.fromStamp));
}

void LossEvidence::judgeLostHere(const Gap& gap, const log::ReceivingPort& port) {
    using enum Gap::Evidence;
    for (const Gap::Evidence evidence : {Dropped, NotListening, Overtaken, OnWay}) {
        Missing as{true, evidence == OnWay ? LossCause::Transport : LossCause::ThisComputer, evidence};
        const auto ofIt = [&](const auto& visit) {
            forEachDrop(gap.fromPacket, gap.toPacket, port, [&](const Drop& drop) {
                if (drop.evidence == evidence) {
                    visit(drop);
                }
            });
        };
        ofIt([&](const Drop& drop) { as.figure += drop.count; });
        ofIt([&](const Drop& drop) { judgeDrop(gap, drop, as); });
    }
}

/// Blames a drop for the samples due just before the packet that reports it, at most as many as it counted,
/// and for one after it: none is due to the millisecond.
void LossEvidence::judgeDrop(const Gap& gap, const Drop& drop, const Missing& as) {
    if (drop.evidence == Gap::Evidence::NotListening) {
        judgeRest(as);
        return;
    }
    std::size_t next = 0; // the first that was due after it
    while (next < m_missing.size() && dueAt(next, gap) <= drop.stamp) {
        ++next;
    }
    std::uint64_t left = drop.count;
    const auto take = [&](std::size_t place) {
        const bool isOpen = m_missing[place].isMissing && !m_missing[place].cause;
        judge(place, as);
        left -= isOpen ? 1 : 0;
    };
    for (std::size_t place = next; place-- > 0 && left != 0;) {
        take(place);
    }
    const std::size_t end = m_isCounterStopped ? m_missing.size() : std::min(next + 1, m_missing.size());
    for (std::size_t place = next; place < end && left != 0; ++place) {
        take(place);
    }
}

void LossEvidence::judgeBrought(const Gap& gap, const Sender& sender) {
    for (const Stream* other : sender.streams) {
        if (other->key == gap.stream) {
            continue;
        }
        other->accounting.forEachBetween(
            gap.fromSample, gap.toSample, [&](std::uint32_t sample, log::Stamp stamp) {
                const auto place = placeOf(sample, gap); // what others bring between is not missing here
                if (place && stamp >= gap.fromStamp - kMeanwhile && stamp < gap.toStamp + kMeanwhile) {
                    judge(*place,
                          {true, LossCause::Network, Gap::Evidence::OtherStream, other->key.type, sample});
                }
            });
    }
}

void LossEvidence::judgeSilent(const Gap& gap, const Host& host) {
    if (m_isCounterStopped) {
        return;
    }
    for (auto silence = host.silences.rbegin();
         silence != host.silences.rend() && silence->when.to > gap.fromStamp; ++silence) {
        const std::size_t hosts = hostsSilentWith(host, *silence);
        const Missing as = hosts > 1 ? Missing{.cause = LossCause::Network,
                                               .evidence = Gap::Evidence::HostsSilent,
                                               .figure = hosts}
                                     : Missing{.cause = LossCause::Sender,
                                               .evidence = Gap::Evidence::Paused,
                                               .figure = host.streams};
        for (std::size_t place = 0; place < m_missing.size(); ++place) {
            const log::Stamp due = dueAt(place, gap);
            if (due > silence->when.from && due < silence->when.to) {
                judge(place, as);
            }
        }
    }
}

/// How many hosts were silent over the same time, itself one of them.
std::size_t LossEvidence::hostsSilentWith(const Host& host, const Silence& silence) const {
    const auto isSame = [&silence](const Silence& other) {
        const log::Duration most = kTogether + std::min(std::max(silence.period, other.period), kTogether);
        return std::chrono::abs(other.when.from - silence.when.from) <= most &&
               std::chrono::abs(other.when.to - silence.when.to) <= most;
    };
    return 1 + static_cast<std::size_t>(std::ranges::count_if(m_hosts, [&](const auto& entry) {
               return &entry.second != &host && std::ranges::any_of(entry.second.silences, isSame);
           }));
}

bool Gap::isAround(std::uint32_t sample) const {
    return distance(sample, fromSample) > 0 && distance(toSample, sample) > 0;
}

std::vector<LossCause> Gap::causes() const {
    std::vector<LossCause> causes;
    for (std::size_t cause = 0; cause < kLossCauses; ++cause) {
        if (shares[cause].lost != 0) {
            causes.push_back(static_cast<LossCause>(cause));
        }
    }
    std::ranges::stable_sort(causes, std::greater(), [this](LossCause cause) { return of(cause).lost; });
    return causes.empty() ? std::vector{LossCause::Unknown} : causes;
}

words::Fact Gap::evidenceFact(LossCause cause) const {
    using K = words::Kind;
    const Share& share = of(cause);
    const auto lastedMs =
        words::Number{static_cast<double>((toStamp - fromStamp) / std::chrono::milliseconds(1))};
    const words::NamedValue sample{"sample", share.figure};
    const words::NamedValue from{"from", fromPacket};
    const words::NamedValue to{"to", toPacket};
    const words::NamedValue samples{"samples", words::counted(K::Samples, isJudged ? share.lost : lost)};
    switch (share.evidence) {
    case Evidence::Dropped:
        return {K::DroppedHere, {{"datagrams", words::counted(K::Datagrams, share.figure)}, from, to}};
    case Evidence::NotListening:
        return {K::NotListening};
    case Evidence::Overtaken:
        return {K::OvertakenBetween, {{"packets", words::counted(K::Packets, share.figure)}, from, to}};
    case Evidence::OnWay:
        return {K::LostOnWay, {{"packets", words::counted(K::Packets, share.figure)}, to}};
    case Evidence::Damaged:
        return {K::SampleDamaged, {sample}};
    case Evidence::OtherStream:
        return {K::OtherStream, {{"type", wire::typeDigits(share.otherType)}, sample}};
    case Evidence::Reliable:
        return {K::NotSentByTcp, {samples}};
    case Evidence::HostsSilent:
        return {K::HostsSilent, {{"hosts", share.figure}, {"lasted", lastedMs}}};
    case Evidence::Paused:
        return {K::Paused, {{"streams", words::counted(K::Streams, share.figure)}, {"lasted", lastedMs}}};
    case Evidence::Uncounted:
        return {K::DropsUncounted, {samples}};
    case Evidence::None:
        break;
    }
    return isJudged ? words::Fact{K::NoEvidence, {samples, {"lasted", lastedMs}}}
                    : words::Fact{K::WaitingForLate};
}

std::size_t LossEvidence::memoryBytes() const {
    std::size_t bytes = m_drops.size() * sizeof(Drop) + m_damages.size() * sizeof(Damage);
    for (const auto& [id, sender] : m_senders) {
        bytes += sizeof(Sender) + sender.streams.capacity() * sizeof(const Stream*);
    }
    for (const auto& [name, host] : m_hosts) {
        bytes += sizeof(host) + name.capacity() + host.silences.size() * sizeof(Silence);
    }
    return bytes;
}

} // namespace posewire::model
