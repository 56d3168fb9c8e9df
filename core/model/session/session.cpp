// SPDX-License-Identifier: MIT
#include "core/model/session/session.h"

#include <algorithm>

namespace posewire::model {
namespace {

constexpr std::size_t kMostStreams = log::StreamIndex::kStreamLimit;
constexpr std::size_t kMostCharacters = 1024;
/// Packets that are not older than this when they are followed are live: silence after them is silence.
constexpr std::int64_t kLiveNs = 10'000'000'000;

std::string shownBytes(wire::Bytes bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : bytes.first(std::min<std::size_t>(bytes.size(), 16))) {
        text += text.empty() ? "" : " ";
        text += digits[std::to_integer<unsigned>(byte) >> 4];
        text += digits[std::to_integer<unsigned>(byte) & 0xf];
    }
    return text;
}

std::string_view hostOf(const log::SenderInfo& info) {
    return std::string_view(info.address).substr(0, info.address.rfind(':'));
}

bool isSameHost(const log::SenderInfo& a, const log::SenderInfo& b) {
    return a.transport == b.transport && a.transport != log::Transport::File && hostOf(a) == hostOf(b);
}

/// Height of the pelvis in the wire's unit, for the detection of units.
std::optional<double> pelvisHeight(const wire::Datagram& datagram) {
    if (const auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body);
        pose && !pose->segments.empty()) {
        return pose->segments.front().position[2];
    }
    if (const auto* linear = std::get_if<wire::LinearKinematics>(&datagram.body);
        linear && !linear->segments.empty()) {
        return linear->segments.front().position[2];
    }
    return std::nullopt;
}

} // namespace

namespace {

/// What a packet changed, tag by tag; empty where it said nothing else than what was known.
std::string changeBy(const Metadata& metadata, std::uint64_t packet) {
    std::string text;
    for (const MetadataTag& tag : metadata.tags()) {
        if (tag.values.size() > 1 && tag.values.back().packet == packet) {
            text += (text.empty() ? "" : ", ") + tag.name + ": " + tag.values[tag.values.size() - 2].text +
                    " → " + tag.values.back().text;
        }
    }
    return text;
}

} // namespace

Session::Session(const log::PacketLog& log) : m_log(log), m_reader(log) {}

bool Session::follow(std::int64_t nowNs, std::size_t most) {
    m_nowNs = nowNs;
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
        m_isLive = newest && nowNs - newest->stampNs < kLiveNs && newest->stampNs - nowNs < kLiveNs;
    }
    if (m_isLive && to == m_reader.end()) {
        m_follower.advance(nowNs);
    }
    m_index.dropBefore(m_begin);
    m_digests.dropBefore(m_begin);
    return to > from;
}

void Session::take(const log::Packet& packet) {
    const bool isRead = !packet.flags.skipped && wire::decodeInto(packet.bytes, m_scratch).has_value();
    PacketDigest digest = digestOf(packet, isRead ? &m_scratch : nullptr);
    if (m_digests.end() == 0) {
        m_firstStampNs = packet.stampNs;
    }
    if (Sender* sender = senderOf(packet)) {
        sender->lastStampNs = packet.stampNs;
        sender->kernelDrops += packet.kernelDropsBefore;
        sender->bytes += packet.bytes.size();
        sender->datagrams += digest.kind == PacketKind::Skipped ? 0 : 1;
        m_follower.takePacket(packet, digest, m_streams);
        for (const Gap& gap : m_attribution.takePacket(packet, sender->info.localPort)) {
            m_follower.takeGap(gap);
        }
        takeFrom(packet, *sender, digest);
    }
    m_digests.append(packet.number, digest);
}

void Session::takeFrom(const log::Packet& packet, Sender& sender, PacketDigest& digest) {
    switch (digest.kind) {
    case PacketKind::Datagram:
        takeDatagram(packet, sender, digest);
        break;
    case PacketKind::Malformed:
        takeMalformed(packet, sender, digest);
        break;
    case PacketKind::Foreign:
        ++sender.foreign;
        sender.foreignBytes += packet.bytes.size();
        sender.firstForeignBytes = shownBytes(packet.bytes);
        break;
    case PacketKind::Skipped:
        sender.skippedBytes += packet.bytes.size();
        break;
    }
}

void Session::takeMalformed(const log::Packet& packet, Sender& sender, const PacketDigest& digest) {
    sender.takeMalformed(packet.stampNs);
    if (const auto header = wire::decodeHeader(packet.bytes)) {
        m_attribution.takeMalformed(packet, *header);
    }
    const auto stream = m_streamIndex.find({packet.sender, digest.character, digest.type});
    if (stream != m_streamIndex.end()) {
        m_streams[stream->second].accounting.addMalformed(packet.stampNs);
    }
}

void Session::takeDatagram(const log::Packet& packet, Sender& sender, PacketDigest& digest) {
    const wire::Header& header = m_scratch.header;
    sender.detector.addHeader(header);
    Stream* stream = streamOf({packet.sender, header.character, header.type()}, sender);
    Character* character = characterOf({packet.sender, header.character}, packet.number);
    if (stream == nullptr || character == nullptr) {
        return;
    }
    m_index.add(packet, header);
    stream->statistics.add(packet.stampNs, packet.bytes.size(), header.datagramIndex() == 0);
    m_follower.takeDatagram(packet, header);
    if (countsSamples(digest.type)) {
        m_attribution.takeSampled(packet.sender, packet.stampNs);
    }
    const std::size_t place = m_streamIndex.at(stream->key);
    for (const Verdict& verdict : addToStream(packet, header, stream->accounting, digest)) {
        if (verdict.packet != packet.number) {
            m_digests.amend(verdict);
        }
        m_attribution.takeVerdict(place, verdict);
        m_follower.takeVerdict(stream->key, verdict);
    }
    character->lastStampNs = packet.stampNs;
    character->lastPacket = packet.number;
    takeContent(packet, *character, sender);
}

void Session::takeContent(const log::Packet& packet, Character& character, Sender& sender) {
    if (const auto* metadata = std::get_if<wire::MetaData>(&m_scratch.body)) {
        character.metadata.add(*metadata, packet.number, packet.stampNs);
        if (std::string change = changeBy(character.metadata, packet.number); !change.empty()) {
            m_follower.takeChange(EventKind::MetadataChange, character.key, packet, std::move(change));
        }
    } else if (const auto* part = std::get_if<wire::NullPose>(&m_scratch.body)) {
        const std::int64_t changedNs = character.nullPoses.record(packet.number).changedNs;
        character.nullPoses.add(*part, m_scratch.header.datagramCounter, packet.number, packet.stampNs);
        const NullPoseRecord record = character.nullPoses.record(packet.number);
        if (record.before != nullptr && record.changedNs != changedNs) {
            m_follower.takeChange(EventKind::ScaleChange, character.key, packet, {});
        }
    } else if (const auto height = pelvisHeight(m_scratch)) {
        sender.detector.addPelvisHeight(*height);
    }
}

Sender* Session::senderOf(const log::Packet& packet) {
    if (const auto found = m_senderIndex.find(packet.sender); found != m_senderIndex.end()) {
        return &m_senders[found->second];
    }
    const log::SenderInfo* info = m_log.senders().find(packet.sender);
    if (info == nullptr) {
        return nullptr;
    }
    const auto before = std::find_if(m_senders.rbegin(), m_senders.rend(),
                                     [&](const Sender& other) { return isSameHost(other.info, *info); });
    const SenderOverride inherited = before != m_senders.rend() ? before->overrides : SenderOverride{};
    m_senderIndex.emplace(packet.sender, m_senders.size());
    Sender& sender = m_senders.emplace_back();
    sender.id = packet.sender;
    sender.info = *info;
    sender.overrides = inherited;
    return &sender;
}

Character* Session::characterOf(const CharacterKey& key, std::uint64_t packetNumber) {
    if (const auto found = m_characterIndex.find(key); found != m_characterIndex.end()) {
        return &m_characters[found->second];
    }
    if (m_characters.size() == kMostCharacters) {
        return nullptr;
    }
    const auto before = lastOfSameHost(key);
    m_characterIndex.emplace(key, m_characters.size());
    Character& character = m_characters.emplace_back();
    character.key = key;
    character.firstPacket = packetNumber;
    character.ordinal = m_characters.size() - 1;
    if (before) {
        Character& previous = m_characters[m_characterIndex.at(*before)];
        previous.after = key;
        character.before = before;
        character.ordinal = previous.ordinal;
    }
    return &character;
}

Stream* Session::streamOf(const log::StreamKey& key, const Sender& sender) {
    if (const auto found = m_streamIndex.find(key); found != m_streamIndex.end()) {
        return &m_streams[found->second];
    }
    if (m_streams.size() == kMostStreams) {
        return nullptr;
    }
    m_streamIndex.emplace(key, m_streams.size());
    Stream& stream = m_streams.emplace_back(key);
    m_attribution.addStream(m_streams.size() - 1, sender.info);
    return &stream;
}

std::optional<CharacterKey> Session::lastOfSameHost(const CharacterKey& key) const {
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

const Character* Session::predecessor(const CharacterKey& key) const {
    const Character* character = find(key);
    const Character* before = character != nullptr && character->before ? find(*character->before) : nullptr;
    return before != nullptr && before->lastPacket < character->firstPacket ? before : nullptr;
}

CharacterKey Session::current(const CharacterKey& key) const {
    const std::uint64_t end = visibleEnd();
    CharacterKey current = key;
    for (const Character* character = find(key); character != nullptr && character->after;) {
        const Character* next = find(*character->after);
        if (next->firstPacket >= end || next->firstPacket <= character->lastPacket) {
            break;
        }
        current = next->key;
        character = next;
    }
    return current;
}

std::vector<const Character*> Session::currentCharacters() const {
    std::vector<const Character*> shown;
    for (const Character& character : m_characters) {
        if (!isSuperseded(character.key)) {
            shown.push_back(&character);
        }
    }
    return shown;
}

void Session::setOverride(log::SenderId sender, const SenderOverride& overrides) {
    const auto found = m_senderIndex.find(sender);
    if (found == m_senderIndex.end()) {
        return;
    }
    m_senders[found->second].overrides = overrides;
    for (auto& [key, cached] : m_poses) {
        if (key.sender == sender) {
            cached.packet = UINT64_MAX;
        }
    }
}

void Session::setMarked(std::uint64_t packet, bool isMarked) {
    if (isMarked) {
        m_annotations.marks.insert(packet);
    } else {
        m_annotations.marks.erase(packet);
    }
}

void Session::setComment(std::uint64_t packet, std::string comment) {
    if (comment.empty()) {
        m_annotations.comments.erase(packet);
    } else {
        m_annotations.comments[packet] = std::move(comment);
    }
}

const Sender* Session::find(log::SenderId id) const {
    const auto found = m_senderIndex.find(id);
    return found == m_senderIndex.end() ? nullptr : &m_senders[found->second];
}

const Character* Session::find(const CharacterKey& key) const {
    const auto found = m_characterIndex.find(key);
    return found == m_characterIndex.end() ? nullptr : &m_characters[found->second];
}

const Stream* Session::find(const log::StreamKey& key) const {
    const auto found = m_streamIndex.find(key);
    return found == m_streamIndex.end() ? nullptr : &m_streams[found->second];
}

template <class Selected, class Counts>
StreamCounts Session::sumOf(Selected isSelected, Counts counts) const {
    StreamCounts sum;
    for (const Stream& stream : m_streams) {
        if (isSelected(stream.key)) {
            sum += counts(stream.accounting);
        }
    }
    return sum;
}

namespace {

auto ofCharacter(const CharacterKey& key) {
    return [key](const log::StreamKey& stream) {
        return CharacterKey{stream.sender, stream.character} == key;
    };
}

auto ofSender(log::SenderId id) {
    return [id](const log::StreamKey& stream) { return stream.sender == id; };
}

auto within(const TimeRange& range) {
    return [range](const StreamAccounting& accounting) {
        return accounting.countsBetween(range.fromNs, range.toNs);
    };
}

constexpr auto kAll = [](const StreamAccounting& accounting) { return accounting.counts(); };

} // namespace

StreamCounts Session::countsOf(const CharacterKey& key) const {
    return sumOf(ofCharacter(key), kAll);
}

StreamCounts Session::countsOf(log::SenderId id) const {
    return sumOf(ofSender(id), kAll);
}

StreamCounts Session::countsOf(const CharacterKey& key, const TimeRange& range) const {
    return sumOf(ofCharacter(key), within(range));
}

StreamCounts Session::countsOf(log::SenderId id, const TimeRange& range) const {
    return sumOf(ofSender(id), within(range));
}

StreamCounts Session::countsBetween(const TimeRange& range) const {
    return sumOf([](const log::StreamKey&) { return true; }, within(range));
}

std::uint64_t Session::visibleEnd() const {
    return m_cursor.mode == Cursor::Mode::Following ? m_end : std::min(m_end, m_cursor.packet + 1);
}

std::uint64_t Session::packetAt(std::int64_t stampNs) const {
    std::uint64_t first = m_begin;
    std::uint64_t last = m_end;
    while (first < last) {
        const std::uint64_t middle = first + (last - first) / 2;
        const auto packet = m_reader.packet(middle);
        if (packet && packet->stampNs > stampNs) {
            last = middle;
        } else {
            first = middle + 1;
        }
    }
    return std::max(m_begin, first == 0 ? 0 : first - 1);
}

std::optional<std::int64_t> Session::pausedStampNs() const {
    return m_cursor.mode == Cursor::Mode::Paused ? std::optional(cursorStampNs()) : std::nullopt;
}

std::optional<TimeRange> Session::range() const {
    if (m_range.fixed || m_range.lastNs <= 0) {
        return m_range.fixed;
    }
    // What arrives at this very moment belongs to it.
    const std::int64_t end = cursorStampNs() + 1;
    return TimeRange{end - m_range.lastNs, end};
}

std::int64_t Session::cursorStampNs() const {
    if (m_cursor.mode == Cursor::Mode::Following) {
        return m_nowNs;
    }
    const auto packet = m_reader.packet(m_cursor.packet);
    return packet ? packet->stampNs : m_nowNs;
}

} // namespace posewire::model
