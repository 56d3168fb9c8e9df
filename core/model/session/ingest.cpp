// SPDX-License-Identifier: MIT
#include "core/model/session/ingest.h"

#include "core/model/accounting/attribution.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/null_pose.h"
#include "core/model/incidents/incident_follower.h"
#include "core/model/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <utility>

namespace posewire::model {
namespace {

/// Packets that are not older than this when they are followed are live: silence after them is silence.
constexpr log::Duration kLive = std::chrono::seconds(10);
/// What was received this long ago is in the log.
constexpr log::Duration kUnderWay = std::chrono::milliseconds(50);
/// Silence is looked at so often while it is short, then each time it is an eighth longer.
constexpr log::Duration kMoment = std::chrono::milliseconds(20);
constexpr log::Duration kShortSilence = std::chrono::seconds(5);
/// Then nothing is left that depends on when it is looked.
constexpr log::Duration kLongSilence = std::chrono::minutes(1);

/// What is large is rare, or strange: whoever looks at it decodes it again.
bool keepsNewest(const log::Packet& packet, const wire::Header& header) {
    return countsSamples(header.type()) && packet.bytes.size() <= Ingest::kMostNewestBytes &&
           wire::findType(header.type()) != nullptr;
}

/// What a packet changed, tag by tag; empty where it brought nothing new.
std::string changeBy(const Metadata& metadata, std::uint64_t packet) {
    std::vector<std::string> changes;
    for (const MetadataTag& tag : metadata.tags()) {
        if (tag.values.size() > 1 && tag.values.back().packet == packet) {
            changes.push_back(tag.name.shown() + ": " + tag.values[tag.values.size() - 2].text.shown() +
                              " → " + tag.values.back().text.shown());
        }
    }
    return listed(changes);
}

} // namespace

Ingest::Ingest(const log::PacketLog& log)
    : m_log(log),
      m_follower(log),
      m_index(log.scratch()),
      m_digests(log.scratch()),
      m_incidents(std::make_unique<IncidentFollower>()),
      m_attribution(std::make_unique<Attribution>(*m_incidents)) {}

Ingest::~Ingest() = default;

void Ingest::setThresholds(const Thresholds& thresholds) {
    m_incidents->setThresholds(thresholds);
}

void Ingest::report(const Occurrence& one) {
    m_incidents->report(one);
}

std::uint64_t Ingest::provisionalNumber(log::SenderId sender) {
    return m_incidents->reserve(sender);
}

bool Ingest::follow(log::Stamp now, std::size_t most) {
    const std::size_t count = takeNew(now, most);
    m_isFile = false;
    if (count > 0 && now - m_observed < kLive && m_observed - now < kLive) {
        m_isLive = true; // also where its end is read late: this program was held up
    }
    if (m_isLive && !m_isHeldUp && m_follower.lag() == 0) {
        passTime(now);
        if (now - m_observed > kLongSilence) {
            advance(now);
        }
        amendGaps();
    }
    return count > 0;
}

bool Ingest::followFile(log::Stamp now, std::size_t most) {
    m_isFile = true;
    return takeNew(now, most) > 0;
}

void Ingest::passTime(log::Stamp until) {
    until = std::min(until, m_observed + kLongSilence);
    while (m_moment <= until) {
        advance(m_moment);
        const log::Duration silence = m_moment - m_observed;
        m_moment += silence < kShortSilence ? kMoment : silence / 8;
    }
}

log::Duration Ingest::behind() const {
    return m_isLive && m_follower.lag() != 0 ? std::max(m_now - m_observed, log::Duration())
                                             : log::Duration();
}

void Ingest::advance(log::Stamp stamp) {
    m_attribution->advance(stamp - kUnderWay);
    m_incidents->advance(stamp);
}

void Ingest::settle() {
    m_streams.forEach([this](Stream& stream) {
        const Character* character = find(CharacterKey{stream.key.sender, stream.key.character});
        for (const Verdict& verdict : stream.accounting.conclude()) {
            m_digests.amend(verdict);
            takeVerdict(stream, verdict, character->isConfirmed);
        }
    });
    m_attribution->settle();
    amendGaps();
}

/// The list of packets shows what is lost as it is counted.
void Ingest::amendGaps() {
    for (const Attribution::Recount& recount : m_attribution->recounts()) {
        m_digests.amendGap(recount.packet, recount.lost);
    }
    m_attribution->clearRecounts();
}

void Ingest::endFile(log::Duration afterLast) {
    m_isLive = false;
    m_fileEnd = m_observed + afterLast;
    if (afterLast > log::Duration::zero()) {
        passTime(m_fileEnd);
        advance(m_fileEnd);
    }
    settle();
    m_incidents->endFile();
}

std::size_t Ingest::takeNew(log::Stamp now, std::size_t most) {
    m_now = now;
    m_follower.refresh();
    m_begin = m_follower.reader().begin();
    m_incidents->followClock(m_log.timeline());
    std::size_t count = 0;
    while (count < most) {
        const auto packet = m_follower.next();
        const log::DropSums unseen = m_follower.takeUnseen();
        m_dropRecordsUnseen += unseen.records;
        if (const std::uint64_t overtaken = m_follower.takeOvertaken(); overtaken > unseen.records) {
            takeOvertaken(overtaken - unseen.records, packet ? &*packet : nullptr);
        }
        if (!packet) {
            break;
        }
        if (unseen.datagrams != 0) {
            takeDropsUnseen(unseen.datagrams, *packet);
        }
        take(*packet);
        ++count;
    }
    m_index.dropBefore(m_begin);
    m_digests.dropBefore(m_begin);
    return count;
}

/// What was lost of the packets that nobody looked at is this computer's loss.
void Ingest::takeOvertaken(std::uint64_t count, const log::Packet* next) {
    const std::uint64_t packet = next != nullptr ? next->number : m_follower.position();
    m_attribution->takeOvertaken(packet, count);
    m_incidents->takeOvertaken(packet, count, next != nullptr ? next->stamp : m_now);
    m_streams.forEach([count](Stream& stream) { stream.accounting.passOver(count); });
}

/// The packets that told of them are among those that were passed over, so nobody knows at which port it was.
void Ingest::takeDropsUnseen(std::uint64_t count, const log::Packet& next) {
    m_dropsUnseen += count;
    m_incidents->takeDropsUnseen(count, next);
    m_streams.forEach([count](Stream& stream) { stream.accounting.passOver(count); });
}

void Ingest::take(const log::Packet& packet) {
    if (m_digests.end() == 0) {
        m_firstStamp = packet.stamp;
    }
    // Who drops packets is held up: silence meanwhile is no evidence.
    if (m_digests.end() != 0 && packet.kernelDropsBefore == 0) {
        passTime(packet.stamp);
    }
    m_observed = packet.stamp;
    m_moment = packet.stamp + kUnderWay;
    Observation seen{packet};
    observe(seen);
    if (seen.sender != nullptr) {
        countPacket(seen);
        judgeGaps(seen);
        if (seen.datagram == nullptr) {
            countFaulty(seen);
        } else if (takeHeader(seen)) {
            account(seen);
            takeContent(seen);
        } else {
            ++m_unfollowed;
        }
    }
    m_digests.append(packet.number, seen.digest);
    amendGaps();
    lookForContradictions();
}

/// Decodes into what is kept of the stream, whose memory fits already.
void Ingest::observe(Observation& seen) {
    const log::Packet& packet = seen.packet;
    seen.sender = senderOf(packet);
    if (const auto header = wire::decodeHeader(packet.bytes); header && !packet.flags.skipped) {
        seen.header = *header;
        seen.stream = m_streams.find({packet.sender, header->character, header->type()});
        if (seen.stream != nullptr) {
            seen.stream->newest.packet = UINT64_MAX;
        }
        const bool isKept = seen.stream != nullptr && keepsNewest(packet, *header);
        Message& into = isKept ? seen.stream->newest : m_unplaced;
        if (wire::decodeInto(packet.bytes, into.datagram)) {
            into.packet = packet.number;
            into.stamp = packet.stamp;
            into.sender = packet.sender;
            seen.datagram = &into.datagram;
        }
    }
    seen.digest = digestOf(packet, seen.datagram);
}

void Ingest::countPacket(const Observation& seen) {
    Sender& sender = *seen.sender;
    sender.lastStamp = seen.packet.stamp;
    sender.kernelDrops += seen.packet.kernelDropsBefore;
    sender.bytes += seen.packet.bytes.size();
    sender.datagrams += seen.digest.kind == PacketKind::Skipped ? 0 : 1;
    const Place& place = m_recencies.at(sender.id);
    place.list->splice(place.list->end(), *place.list, place.at);
    m_incidents->takePacket(seen.packet, seen.digest, seen.header);
    passOverDropped(seen);
}

/// What the socket dropped may have been of any stream that it hears: a counter that is as far ahead did not
/// restart.
void Ingest::passOverDropped(const Observation& seen) {
    if (seen.packet.kernelDropsBefore == 0) {
        return;
    }
    m_streams.forEach([&](Stream& stream) {
        const Sender* sender = find(stream.key.sender);
        if (sender != nullptr && sender->info.localPort == seen.sender->info.localPort) {
            stream.accounting.passOver(seen.packet.kernelDropsBefore);
        }
    });
}

void Ingest::judgeGaps(const Observation& seen) {
    m_attribution->takePacket(seen.packet, seen.sender->info.localPort);
}

void Ingest::countFaulty(const Observation& seen) {
    Sender& sender = *seen.sender;
    switch (seen.digest.kind) {
    case PacketKind::Datagram:
        break;
    case PacketKind::Malformed:
        sender.takeMalformed(seen.packet.stamp);
        if (seen.header) {
            m_attribution->takeMalformed(seen.packet, *seen.header);
        }
        if (seen.stream != nullptr) {
            seen.stream->accounting.addMalformed(seen.packet.stamp);
        }
        break;
    case PacketKind::Foreign:
        sender.takeForeign(seen.packet.bytes);
        break;
    case PacketKind::Skipped:
        sender.skippedBytes += seen.packet.bytes.size();
        break;
    }
}

/// False where there are too many streams or characters already.
bool Ingest::takeHeader(Observation& seen) {
    const log::Packet& packet = seen.packet;
    const wire::Header& header = *seen.header;
    seen.sender->detector.addHeader(header);
    promote(*seen.sender);
    seen.character = characterOf(*seen.sender, header.character, packet.number);
    if (seen.character == nullptr) {
        return false;
    }
    if (seen.stream == nullptr) {
        seen.stream = streamOf({packet.sender, header.character, header.type()}, *seen.sender);
        if (seen.stream == nullptr) {
            return false;
        }
        seen.character->streams.push_back(seen.stream);
        if (keepsNewest(packet, header)) {
            seen.stream->newest = m_unplaced; // no more of its memory than this one needs
        }
    }
    m_index.add(packet, header);
    if (keepsNewest(packet, header)) {
        seen.stream->newestBytes = std::max(seen.stream->newestBytes, packet.bytes.size());
    }
    seen.stream->statistics.add(packet.stamp);
    if (seen.character->isConfirmed ||
        (seen.character->isConfirmed = m_unconfirmed.take(seen.character->key, packet, header))) {
        m_incidents->takeDatagram(packet, header, *seen.stream, seen.sender->info.address);
    }
    seen.character->lastStamp = packet.stamp;
    seen.character->lastPacket = packet.number;
    return true;
}

void Ingest::account(Observation& seen) {
    const log::Packet& packet = seen.packet;
    Stream& stream = *seen.stream;
    const bool isSampled = countsSamples(seen.digest.type);
    if (isSampled) {
        m_attribution->takeSampled(packet.sender, packet.stamp);
    } else if (seen.header->datagramIndex() == 0) {
        stream.statistics.addSample(packet.stamp);
    }
    for (const Verdict& verdict : addToStream(packet, *seen.header, stream.accounting, seen.digest)) {
        if (verdict.packet != packet.number) {
            m_digests.amend(verdict);
        }
        if (isSampled && verdict.isFirstOfSample) {
            stream.statistics.addSample(verdict.stamp);
        }
        takeVerdict(stream, verdict, seen.character->isConfirmed);
    }
}

void Ingest::takeVerdict(Stream& stream, const Verdict& verdict, bool isConfirmed) {
    m_attribution->takeVerdict(stream, verdict);
    if (isConfirmed) {
        m_incidents->takeVerdict(stream, verdict);
    }
}

void Ingest::takeContent(const Observation& seen) {
    if (const auto* message = std::get_if<wire::MetaData>(&seen.datagram->body)) {
        takeMetadata(*message, seen);
    } else if (const auto* part = std::get_if<wire::NullPose>(&seen.datagram->body)) {
        takeNullPose(*part, seen);
    } else if (seen.header->datagramIndex() == 0) {
        seen.sender->detector.addBody(seen.datagram->body);
        if (BodyMeasure& body = seen.character->measuredBody;
            !body.isSettled() && hasPoses(seen.header->type()) && nullPoses(seen.character->key) == nullptr) {
            body.add(*seen.datagram, seen.sender->positionUnit(seen.header->type()));
        }
    }
}

void Ingest::takeMetadata(const wire::MetaData& message, const Observation& seen) {
    const log::Packet& packet = seen.packet;
    Metadata& metadata = seen.character->metadata;
    const std::size_t before = metadata.memoryBytes();
    metadata.add(message, packet.number, packet.stamp);
    if (std::string change = changeBy(metadata, packet.number); !change.empty()) {
        m_incidents->takeChange(IncidentKind::MetadataChange, seen.character->key, packet,
                                {words::Kind::MetadataChanged, {{"changes", std::move(change)}}});
    }
    if (m_metadataKeeping.grew(before, metadata.memoryBytes())) {
        std::vector<Metadata*> all;
        m_characters.forEach([&all](Character& each) { all.push_back(&each.metadata); });
        m_metadataKeeping.keepWithin(all);
    }
}

void Ingest::takeNullPose(const wire::NullPose& part, const Observation& seen) {
    const log::Packet& packet = seen.packet;
    std::shared_ptr<NullPoseHistory>& kept = m_nullPoses[seen.character->key];
    kept = kept != nullptr ? kept : std::make_shared<NullPoseHistory>();
    NullPoseHistory& history = *kept;
    const std::size_t before = history.memoryBytes();
    if (history.add(part, seen.header->datagramCounter, packet.number, packet.stamp)) {
        m_incidents->takeChange(IncidentKind::ScaleChange, seen.character->key, packet, {});
    }
    lookAtNullPose(history.record(packet.number), *seen.character, packet);
    if (m_nullPoseKeeping.grew(before, history.memoryBytes())) {
        std::vector<NullPoseHistory*> all;
        for (const auto& [key, each] : m_nullPoses) {
            all.push_back(each.get());
        }
        m_nullPoseKeeping.keepWithin(all);
    }
}

const NullPoseHistory* Ingest::nullPoses(const CharacterKey& key) const {
    const auto found = m_nullPoses.find(key);
    return found == m_nullPoses.end() ? nullptr : found->second.get();
}

const Message* Ingest::newest(const log::StreamKey& key) const {
    const Stream* stream = find(key);
    return stream != nullptr && stream->newest.packet != UINT64_MAX ? &stream->newest : nullptr;
}

AccountingDepth Ingest::depthNow() const {
    const AccountingDepth now = AccountingDepth::of(m_streams.size());
    // Deeper again only where it will last.
    const bool isDeeper = now.samples > m_depth.samples;
    const AccountingDepth soon = AccountingDepth::of(m_streams.size() + m_streams.size() / 3);
    return isDeeper && soon.samples <= m_depth.samples ? m_depth : now;
}

void Ingest::fitDepth() {
    const AccountingDepth depth = depthNow();
    if (depth == m_depth) {
        return;
    }
    m_depth = depth;
    m_streams.forEach([this](Stream& stream) {
        stream.accounting.setDepth(m_depth);
        Attribution::expectJudgement(stream);
    });
}

} // namespace posewire::model
