// SPDX-License-Identifier: MIT
#include "core/model/session/ingest.h"

#include "core/model/accounting/attribution.h"
#include "core/model/accounting/event_follower.h"
#include "core/model/body/null_pose.h"
#include "core/model/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace posewire::model {
namespace {

constexpr std::size_t kMostStreams = log::StreamIndex::kStreamLimit;
constexpr std::size_t kMostCharacters = 1024;
/// Packets that are not older than this when they are followed are live: silence after them is silence.
constexpr log::Duration kLive = std::chrono::seconds(10);

std::string_view hostOf(const log::SenderInfo& info) {
    return std::string_view(info.address).substr(0, info.address.rfind(':'));
}

bool isSameHost(const log::SenderInfo& a, const log::SenderInfo& b) {
    return a.transport == b.transport && a.transport != log::Transport::File && hostOf(a) == hostOf(b);
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

/// Null where the key is not known.
template <class Places, class Items>
auto* itemAt(const Places& places, const typename Places::key_type& key, Items& items) {
    const auto found = places.find(key);
    return found == places.end() ? nullptr : &items[found->second];
}

} // namespace

Ingest::Ingest(const log::PacketLog& log)
    : m_log(log),
      m_reader(log),
      m_attribution(std::make_unique<Attribution>(m_streams)),
      m_follower(std::make_unique<EventFollower>()) {}

Ingest::~Ingest() = default;

void Ingest::setThresholds(const Thresholds& thresholds) {
    m_follower->setThresholds(thresholds);
}

bool Ingest::follow(log::Stamp now, std::size_t most) {
    m_now = now;
    m_reader.refresh();
    m_begin = m_reader.begin();
    const std::uint64_t from = std::max(m_end, m_begin);
    const std::uint64_t to = std::min(m_reader.end(), from + most);
    for (std::uint64_t number = from; number < to; ++number) {
        if (const auto packet = m_reader.packet(number)) {
            take(*packet);
        }
    }
    m_end = std::max(m_end, to);
    if (to > from) {
        const auto newest = m_reader.packet(to - 1);
        m_isLive = newest && now - newest->stamp < kLive && newest->stamp - now < kLive;
    }
    if (m_isLive && to == m_reader.end()) {
        m_follower->advance(now);
    }
    m_index.dropBefore(m_begin);
    m_digests.dropBefore(m_begin);
    return to > from;
}

void Ingest::followFile() {
    // However new its packets are, they are no reason to take it for live.
    const log::Stamp now = m_now;
    while (follow({}, 200'000)) {
    }
    m_now = now;
    m_isLive = false;
    m_follower->endFile();
}

void Ingest::take(const log::Packet& packet) {
    if (m_digests.end() == 0) {
        m_firstStamp = packet.stamp;
    }
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
        }
    }
    m_digests.append(packet.number, seen.digest);
}

/// Decodes into what is kept of the stream, whose memory fits already.
void Ingest::observe(Observation& seen) {
    const log::Packet& packet = seen.packet;
    seen.sender = senderOf(packet);
    if (const auto header = wire::decodeHeader(packet.bytes); header && !packet.flags.skipped) {
        seen.header = *header;
        seen.stream = placeOf({packet.sender, header->character, header->type()});
        const bool isKept = seen.stream && wire::findType(header->type()) != nullptr;
        Message& into = isKept ? m_newest[*seen.stream] : m_unplaced;
        into.packet = UINT64_MAX;
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
    m_follower->takePacket(seen.packet, seen.digest, m_streams);
}

void Ingest::judgeGaps(const Observation& seen) {
    for (const Gap& gap : m_attribution->takePacket(seen.packet, seen.sender->info.localPort)) {
        m_follower->takeGap(gap);
    }
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
        if (seen.stream) {
            m_streams[*seen.stream].accounting.addMalformed(seen.packet.stamp);
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
    if (!seen.stream) {
        seen.stream = addStream({packet.sender, header.character, header.type()}, *seen.sender);
        if (seen.stream && wire::findType(header.type()) != nullptr) {
            std::swap(m_newest[*seen.stream], m_unplaced);
            seen.datagram = &m_newest[*seen.stream].datagram;
        }
    }
    seen.character = characterOf({packet.sender, header.character}, packet.number);
    if (!seen.stream || seen.character == nullptr) {
        return false;
    }
    m_index.add(packet, header);
    m_streams[*seen.stream].statistics.add(packet.stamp, header.datagramIndex() == 0);
    m_follower->takeDatagram(packet, header);
    seen.character->lastStamp = packet.stamp;
    seen.character->lastPacket = packet.number;
    return true;
}

void Ingest::account(Observation& seen) {
    const log::Packet& packet = seen.packet;
    if (countsSamples(seen.digest.type)) {
        m_attribution->takeSampled(packet.sender, packet.stamp);
    }
    Stream& stream = m_streams[*seen.stream];
    for (const Verdict& verdict : addToStream(packet, *seen.header, stream.accounting, seen.digest)) {
        if (verdict.packet != packet.number) {
            m_digests.amend(verdict);
        }
        m_attribution->takeVerdict(*seen.stream, verdict);
        m_follower->takeVerdict(stream.key, verdict);
    }
}

void Ingest::takeContent(const Observation& seen) {
    if (const auto* message = std::get_if<wire::MetaData>(&seen.datagram->body)) {
        takeMetadata(*message, seen);
    } else if (const auto* part = std::get_if<wire::NullPose>(&seen.datagram->body)) {
        takeNullPose(*part, seen);
    } else if (seen.header->datagramIndex() == 0) {
        seen.sender->detector.addBody(seen.datagram->body);
    }
}

void Ingest::takeMetadata(const wire::MetaData& message, const Observation& seen) {
    const log::Packet& packet = seen.packet;
    Metadata& metadata = seen.character->metadata;
    const std::size_t before = metadata.memoryBytes();
    metadata.add(message, packet.number, packet.stamp);
    if (std::string change = changeBy(metadata, packet.number); !change.empty()) {
        m_follower->takeChange(EventKind::MetadataChange, seen.character->key, packet, std::move(change));
    }
    if (m_metadataKeeping.grew(before, metadata.memoryBytes())) {
        std::vector<Metadata*> all;
        for (Character& each : m_characters) {
            all.push_back(&each.metadata);
        }
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
        m_follower->takeChange(EventKind::ScaleChange, seen.character->key, packet, {});
    }
    if (m_nullPoseKeeping.grew(before, history.memoryBytes())) {
        std::vector<NullPoseHistory*> all;
        for (const auto& [key, each] : m_nullPoses) {
            all.push_back(each.get());
        }
        m_nullPoseKeeping.keepWithin(all);
    }
}

Sender* Ingest::senderOf(const log::Packet& packet) {
    if (Sender* known = itemAt(m_senderPlaces, packet.sender, m_senders)) {
        return known;
    }
    const log::SenderInfo* info = m_log.senders().find(packet.sender);
    if (info == nullptr) {
        return nullptr;
    }
    const auto before = std::find_if(m_senders.rbegin(), m_senders.rend(),
                                     [&](const Sender& other) { return isSameHost(other.info, *info); });
    const SenderOverride inherited = before != m_senders.rend() ? before->overrides : SenderOverride{};
    m_senderPlaces.emplace(packet.sender, m_senders.size());
    Sender& sender = m_senders.emplace_back();
    sender.id = packet.sender;
    sender.info = *info;
    sender.overrides = inherited;
    return &sender;
}

Character* Ingest::characterOf(const CharacterKey& key, std::uint64_t packetNumber) {
    if (Character* known = itemAt(m_characterPlaces, key, m_characters)) {
        return known;
    }
    if (m_characters.size() == kMostCharacters) {
        return nullptr;
    }
    const auto before = lastOfSameHost(key);
    m_characterPlaces.emplace(key, m_characters.size());
    Character& character = m_characters.emplace_back();
    character.key = key;
    character.firstPacket = packetNumber;
    character.ordinal = m_characters.size() - 1;
    if (before) {
        Character& previous = m_characters[m_characterPlaces.at(*before)];
        previous.after = key;
        character.before = before;
        character.ordinal = previous.ordinal;
    }
    return &character;
}

std::optional<std::size_t> Ingest::addStream(const log::StreamKey& key, const Sender& sender) {
    if (m_streams.size() == kMostStreams) {
        return std::nullopt;
    }
    const std::size_t place = m_streams.size();
    m_streamPlaces.emplace(key, place);
    m_streams.emplace_back(key);
    m_newest.emplace_back();
    m_attribution->addStream(place, sender.info);
    return place;
}

std::optional<CharacterKey> Ingest::lastOfSameHost(const CharacterKey& key) const {
    const Sender* own = find(key.sender);
    const Character* newest = nullptr;
    for (const Character& other : m_characters) {
        const Sender* sender = find(other.key.sender);
        if (other.key.character == key.character && own != nullptr && sender != nullptr &&
            isSameHost(own->info, sender->info) &&
            (newest == nullptr || other.lastPacket > newest->lastPacket)) {
            newest = &other;
        }
    }
    return newest != nullptr ? std::optional(newest->key) : std::nullopt;
}

void Ingest::setOverride(log::SenderId sender, const SenderOverride& overrides) {
    if (Sender* known = itemAt(m_senderPlaces, sender, m_senders)) {
        known->overrides = overrides;
    }
}

const Sender* Ingest::find(log::SenderId id) const {
    return itemAt(m_senderPlaces, id, m_senders);
}

const Character* Ingest::find(const CharacterKey& key) const {
    return itemAt(m_characterPlaces, key, m_characters);
}

std::optional<std::size_t> Ingest::placeOf(const log::StreamKey& key) const {
    const auto found = m_streamPlaces.find(key);
    return found == m_streamPlaces.end() ? std::nullopt : std::optional(found->second);
}

const Stream* Ingest::find(const log::StreamKey& key) const {
    return itemAt(m_streamPlaces, key, m_streams);
}

const NullPoseHistory* Ingest::nullPoses(const CharacterKey& key) const {
    const auto found = m_nullPoses.find(key);
    return found == m_nullPoses.end() ? nullptr : found->second.get();
}

std::size_t Ingest::metadataBytes() const {
    return std::transform_reduce(m_characters.begin(), m_characters.end(), std::size_t{0}, std::plus(),
                                 [](const Character& each) { return each.metadata.memoryBytes(); });
}

std::size_t Ingest::nullPoseBytes() const {
    return std::transform_reduce(m_nullPoses.begin(), m_nullPoses.end(), std::size_t{0}, std::plus(),
                                 [](const auto& each) { return each.second->memoryBytes(); });
}

const Message* Ingest::newest(const log::StreamKey& key) const {
    const Message* newest = itemAt(m_streamPlaces, key, m_newest);
    return newest != nullptr && newest->packet != UINT64_MAX ? newest : nullptr;
}

} // namespace posewire::model
