// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_measures.h"
#include "core/model/body/reference_body.h"
#include "core/model/session/message_parts.h"
#include "core/model/session/session.h"

#include <algorithm>

/// What the session reads from the log at its cursor.
namespace posewire::model {
namespace {

constexpr std::int64_t kPoseTieNs = 250'000'000;
constexpr std::array<std::uint8_t, 3> kPoseTypes{wire::PoseQuaternion::kType, wire::PoseEuler::kType,
                                                 wire::PoseUnity::kType};

/// So many entries are looked at for the parts of one sample: 128 indices, each at most twice.
constexpr std::size_t kPartSearch = 256;

} // namespace

/// Entries of packets that the cursor has reached.
std::size_t Session::visibleCount(const log::StreamEntries& entries) const {
    const std::uint64_t end = visibleEnd();
    if (end == 0) {
        return 0;
    }
    const auto newest = entries.atOrBeforePacket(end - 1);
    return newest ? *newest + 1 : 0;
}

bool Session::readWhole(const log::StreamEntry& entry, Message& message) const {
    const auto packet = m_reader.packet(entry.packet);
    if (!packet || !wire::decodeInto(packet->bytes, message.datagram)) {
        return false;
    }
    message.stampNs = packet->stampNs;
    message.packet = entry.packet;
    return true;
}

/// The newest sample among the first `count` entries whose datagrams are all there.
bool Session::readMessage(const log::StreamEntries& entries, std::size_t count, Message& message) const {
    const std::size_t oldest = count > kPartSearch ? count - kPartSearch : 0;
    for (std::size_t i = count; i-- > oldest;) {
        const log::StreamEntry& last = entries[i];
        if (!last.isLast) {
            continue;
        }
        if (last.datagram == 0) {
            return readWhole(last, message);
        }
        std::array<std::size_t, 128> places{};
        std::size_t present = 0;
        const std::size_t end = std::min(count, i + kPartSearch);
        for (std::size_t k = oldest; k < end; ++k) {
            if (entries[k].sample == last.sample && entries[k].datagram <= last.datagram) {
                std::size_t& place = places[entries[k].datagram];
                present += place == 0 ? 1 : 0;
                place = k + 1;
            }
        }
        if (present != last.datagram + std::size_t{1} || !readWhole(entries[places[0] - 1], message)) {
            continue;
        }
        for (std::size_t part = 1; part <= last.datagram; ++part) {
            if (readWhole(entries[places[part] - 1], m_part)) {
                appendPart(message.datagram, m_part.datagram);
            }
        }
        message.packet = last.packet;
        message.stampNs = last.stampNs;
        return true;
    }
    return false;
}

const Session::Message* Session::message(const CharacterKey& key, std::uint8_t type) const {
    const log::StreamKey streamKey{key.sender, key.character, type};
    const log::StreamEntries* stream = entries(streamKey);
    const std::size_t count = stream != nullptr ? visibleCount(*stream) : 0;
    if (count == 0) {
        const Character* before = predecessor(key);
        return before != nullptr ? message(before->key, type) : nullptr;
    }
    CachedMessage& cached = m_messages[streamKey];
    const std::uint64_t newest = (*stream)[count - 1].packet;
    if (cached.packet != newest) {
        cached.isValid = readMessage(*stream, count, cached.message);
        cached.packet = newest;
    }
    return cached.isValid ? &cached.message : nullptr;
}

std::size_t Session::visit(const log::StreamKey& key, std::int64_t fromStampNs, std::size_t most,
                           const std::function<void(const Message&)>& visitor) const {
    const log::StreamEntries* stream = entries(key);
    const std::size_t count = stream != nullptr ? visibleCount(*stream) : 0;
    if (count == 0) {
        return 0;
    }
    const auto before = stream->atOrBeforeStamp(fromStampNs - 1);
    const std::size_t first = std::max(before ? *before + 1 : 0, count > most ? count - most : 0);
    std::size_t visited = 0;
    for (std::size_t i = first; i < count; ++i) {
        const log::StreamEntry& entry = (*stream)[i];
        if (entry.isLast && entry.datagram == 0 && readWhole(entry, m_visited)) {
            visitor(m_visited);
            ++visited;
        }
    }
    return visited;
}

const CharacterPose* Session::pose(const CharacterKey& key) const {
    const Message* best = nullptr;
    for (const std::uint8_t type : kPoseTypes) {
        const Message* candidate = message(key, type);
        if (candidate != nullptr && (best == nullptr || candidate->stampNs > best->stampNs + kPoseTieNs)) {
            best = candidate;
        }
    }
    if (best == nullptr) {
        return nullptr;
    }
    CachedPose& cached = m_poses[key];
    if (cached.packet != best->packet) {
        const auto origins = bodyOrigins(key);
        const Sender* sender = find(key.sender);
        const auto unit = sender != nullptr ? sender->overrides.positionUnit : std::nullopt;
        cached.isValid = poseFromMessage(best->datagram, origins, cached.pose, unit);
        cached.packet = best->packet;
        cached.pose.stampNs = best->stampNs;
        cached.pose.packet = best->packet;
    }
    return cached.isValid ? &cached.pose : nullptr;
}

const NullPose* Session::nullPose(const CharacterKey& key) const {
    const Character* character = find(key);
    const std::uint64_t end = visibleEnd();
    const NullPose* pose = character != nullptr && end != 0 ? character->nullPoses.at(end - 1) : nullptr;
    const Character* before = pose == nullptr ? predecessor(key) : nullptr;
    return before != nullptr ? nullPose(before->key) : pose;
}

std::vector<Eigen::Vector3d> Session::bodyOrigins(const CharacterKey& key) const {
    const NullPose* pose = nullPose(key);
    const auto& reference = referenceOrigins();
    std::vector<Eigen::Vector3d> origins(reference.begin(), reference.end());
    if (pose != nullptr && pose->segments.size() >= origins.size()) {
        const BodyPlaces places = bodyPlaces(*pose);
        for (std::size_t i = 0; i < origins.size(); ++i) {
            origins[i] = originOf(*pose, places, static_cast<int>(i)).value_or(origins[i]);
        }
    }
    return origins;
}

const Metadata& Session::metadata(const CharacterKey& key) const {
    const Character* character = find(key);
    for (const Character* other = character; other != nullptr; other = predecessor(other->key)) {
        if (!other->metadata.tags().empty()) {
            return other->metadata;
        }
    }
    return character->metadata;
}

std::string_view Session::metadataValue(const CharacterKey& key, std::string_view tag) const {
    const Character* character = find(key);
    const std::uint64_t end = visibleEnd();
    const std::string_view value =
        character != nullptr && end != 0 ? character->metadata.value(tag, end - 1) : std::string_view();
    const Character* before = value.empty() ? predecessor(key) : nullptr;
    return before != nullptr ? metadataValue(before->key, tag) : value;
}

std::string Session::displayName(const CharacterKey& key) const {
    const std::string_view name = metadataValue(key, "name");
    return name.empty() ? "Character " + std::to_string(key.character) : std::string(name);
}

Colour Session::colour(const CharacterKey& key) const {
    const auto sent = parseColour(metadataValue(key, "color"));
    const Character* character = find(key);
    return sent ? *sent : defaultColour(character != nullptr ? character->ordinal : 0);
}

Condition Session::conditionOf(const CharacterKey& key) const {
    if (isSuperseded(key)) {
        return {};
    }
    const Condition condition = m_follower.conditionOf(key, pausedStampNs());
    if (condition.level != Condition::Level::Good) {
        return condition;
    }
    const double age = ageSeconds(key);
    if (age >= Condition::kStaleS) {
        return {Condition::Level::Error, "Nothing has come for more than 1 s.", {}};
    }
    if (age >= Condition::kSilentS) {
        return {Condition::Level::Warning, "Nothing has come for more than a quarter of a second.", {}};
    }
    const Sender* sender = find(key.sender);
    const auto contradictions = sender != nullptr ? sender->contradictions() : std::vector<Contradiction>();
    return contradictions.empty() ? condition
                                  : Condition{Condition::Level::Warning, contradictions.front().text, {}};
}

double Session::ageSeconds(const CharacterKey& key) const {
    const Character* character = find(key);
    if (character == nullptr) {
        return 0;
    }
    std::int64_t newest = character->lastStampNs;
    if (m_cursor.mode == Cursor::Mode::Paused) {
        newest = 0;
        for (const Stream& stream : m_streams) {
            const bool isHis = stream.key.sender == key.sender && stream.key.character == key.character;
            const log::StreamEntries* list = isHis ? entries(stream.key) : nullptr;
            const std::size_t count = list != nullptr ? visibleCount(*list) : 0;
            newest = count != 0 ? std::max(newest, (*list)[count - 1].stampNs) : newest;
        }
    }
    return std::max(0.0, static_cast<double>(cursorStampNs() - newest) * 1e-9);
}

} // namespace posewire::model
