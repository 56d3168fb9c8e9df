// SPDX-License-Identifier: MIT
#include "core/model/session/counting.h"

#include "core/model/incidents/incident_follower.h"

namespace posewire::model {
namespace {

/// A stream that ended and comes back later than this begins again; sooner, what is missing between is lost.
constexpr log::Duration kUnsent = std::chrono::seconds(1);

/// A sample that others have overtaken is no sign that its sender goes on.
bool isLate(std::span<const Verdict> verdicts) {
    return !verdicts.empty() && verdicts.back().isReordered && verdicts.back().isFirstOfSample;
}

} // namespace

Counting::Counting(const std::shared_ptr<log::Scratch>& scratch, Roll& roll, IncidentFollower& incidents)
    : m_roll(roll), m_incidents(incidents), m_attribution(incidents), m_index(scratch), m_digests(scratch) {}

void Counting::takePacket(const Observed& seen) {
    Sender& sender = *seen.sender;
    m_observed = seen.packet.stamp;
    sender.lastStamp = seen.packet.stamp;
    sender.kernelDrops += seen.packet.droppedBefore();
    sender.hasUncountedDrops |= seen.packet.flags.dropsUncounted;
    sender.bytes += seen.packet.bytes.size();
    sender.datagrams += seen.digest.kind == PacketKind::Skipped ? 0 : 1;
    m_incidents.takePacket(seen.packet, seen.digest, seen.header);
    passOverDropped(seen);
    m_attribution.takePacket(seen.packet, sender.info);
}

/// Any stream that the socket hears, or that comes the same way, may lack datagrams: a counter that is as far
/// ahead did not restart.
void Counting::passOverDropped(const Observed& seen) {
    if (seen.packet.kernelDropsBefore == 0) {
        return;
    }
    m_roll.streams().forEach([&](Stream& stream) {
        const Sender* sender = m_roll.senders().find(stream.key.sender);
        const bool isOfPort = sender != nullptr && sender->info.port() == seen.sender->info.port();
        if (isOfPort || (seen.packet.flags.isLostOnWay && sender != nullptr &&
                         sender->info.probe == seen.sender->info.probe)) {
            stream.accounting.passOver(seen.packet.kernelDropsBefore);
        }
    });
}

void Counting::takeFaulty(const Observed& seen) {
    Sender& sender = *seen.sender;
    switch (seen.digest.kind) {
    case PacketKind::Datagram:
        break;
    case PacketKind::Malformed:
        sender.takeMalformed(seen.packet.stamp);
        if (seen.header) {
            m_attribution.evidence().takeMalformed(seen.packet, *seen.header);
        }
        if (seen.stream != nullptr) {
            seen.stream->accounting.addMalformed(seen.packet.stamp);
        }
        break;
    case PacketKind::Foreign:
        sender.takeForeign(seen.packet.bytes);
        break;
    case PacketKind::Skipped:
        sender.takeSkipped(seen.packet.bytes);
        break;
    }
}

void Counting::index(const Observed& seen) {
    wire::Header header = *seen.header;
    if (seen.stream->accounting.framing().isUnmarked()) {
        header.markLast();
    }
    m_index.add(seen.packet, header);
}

void Counting::takeDatagram(Observed& seen) {
    const log::Packet& packet = seen.packet;
    Stream& stream = *seen.stream;
    index(seen);
    stream.statistics.add(packet.stamp);
    if (stream.hasEnded && packet.stamp - stream.accounting.lastStamp() >= kUnsent) {
        stream.accounting.beginRun(packet.stamp);
    }
    const auto verdicts = addToStream(packet, *seen.header, stream.accounting, seen.digest);
    const bool isSampled = countsSamples(seen.digest.type);
    const bool isConfirmed = seen.character->isConfirmed;
    if (isConfirmed) {
        const bool isAlone = m_roll.senders().size() == 1; // nobody else can claim the character
        const std::string_view name =
            isAlone ? "" : seen.character->metadata.value("name", packet.number).exact();
        m_incidents.takeDatagram(packet, *seen.header, stream, {seen.sender->info, name}, isLate(verdicts));
    }
    if (isSampled && !isLate(verdicts)) {
        m_attribution.evidence().takeSampled(packet.sender, packet.stamp, seen.header->sampleCounter);
    }
    stream.addSamples(packet.stamp, *seen.header, verdicts);
    for (const Verdict& verdict : verdicts) {
        if (verdict.packet != packet.number) {
            m_digests.amend(verdict);
        }
        takeVerdict(stream, verdict, isConfirmed);
    }
}

void Counting::close(const Observed& seen) {
    m_digests.append(seen.packet.number, seen.digest);
    amendGaps();
}

void Counting::takeOvertaken(std::uint64_t packet, std::uint64_t count, log::Stamp stamp) {
    m_attribution.evidence().takeOvertaken(packet, count, stamp);
    m_incidents.takeOvertaken(packet, count, stamp);
    passOver(count);
}

void Counting::takeDropsUnseen(std::uint64_t count, const log::Packet& next) {
    m_incidents.takeDropsUnseen(count, next);
    passOver(count);
}

void Counting::passOver(std::uint64_t count) {
    m_roll.streams().forEach([count](Stream& stream) { stream.accounting.passOver(count); });
}

void Counting::advance(log::Stamp stamp) {
    m_attribution.advance(stamp - kUnderWay);
    m_incidents.advance(stamp);
    amendGaps();
}

void Counting::settle() {
    m_roll.streams().forEach([this](Stream& stream) {
        const Character* character =
            m_roll.characters().find(CharacterKey{stream.key.sender, stream.key.character});
        for (const Verdict& verdict : stream.accounting.conclude()) {
            m_digests.amend(verdict);
            takeVerdict(stream, verdict, character->isConfirmed);
        }
    });
    m_attribution.settle();
    amendGaps();
}

void Counting::dropBefore(std::uint64_t packet) {
    m_index.dropBefore(packet);
    m_digests.dropBefore(packet);
}

void Counting::began(Stream& stream, const Sender& sender) {
    stream.accounting.setDepth(m_depth);
    stream.accounting.setEdges(m_roll.edges());
    fitDepth();
    m_attribution.evidence().addStream(stream, sender.info);
}

void Counting::tookOver(const CharacterKey& before, const CharacterKey& after, log::Stamp since) {
    m_incidents.supersede(before, after, since);
}

void Counting::isAwaited(const CharacterKey& key) {
    m_incidents.expect(key);
}

void Counting::goes(const Sender& sender) {
    m_attribution.retire(sender.id);
    m_incidents.retire(sender.id);
    for (const Character* character : sender.characters) {
        for (const Stream* stream : character->streams) {
            m_index.forget(stream->key);
        }
    }
}

void Counting::takeVerdict(Stream& stream, const Verdict& verdict, bool isConfirmed) {
    m_attribution.takeVerdict(stream, verdict);
    if (isConfirmed) {
        m_incidents.takeVerdict(stream, verdict);
    }
}

/// The list of packets shows what is lost as it is counted.
void Counting::amendGaps() {
    for (const Attribution::Recount& recount : m_attribution.recounts()) {
        m_digests.amendGap(recount.packet, recount.lost);
    }
    m_attribution.clearRecounts();
}

/// Depth that is given up comes back only if it will last.
void Counting::fitDepth() {
    const std::size_t streams = m_roll.streams().size();
    const AccountingDepth depth = AccountingDepth::of(streams);
    const AccountingDepth soon = AccountingDepth::of(streams + streams / 3);
    if (depth == m_depth || (depth.samples > m_depth.samples && soon.samples <= m_depth.samples)) {
        return;
    }
    m_depth = depth;
    m_roll.streams().forEach([this](Stream& stream) {
        stream.accounting.setDepth(m_depth);
        Attribution::expectJudgement(stream);
    });
}

} // namespace posewire::model
