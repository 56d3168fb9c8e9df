// SPDX-License-Identifier: MIT
#include "core/feed/pose_feed.h"

#include "core/feed/sample_order.h"
#include "core/log/log_reader.h"
#include "core/model/body/null_pose_measures.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace posewire::feed {
namespace {

using model::kPoseTypes;
using model::kSentTogether;

/// Packets that are read in one step.
constexpr std::uint64_t kPacketsAtOnce = 2048;
/// Samples before the newest one in which messages of one sample may be found.
constexpr std::size_t kRecent = 8;
constexpr std::size_t kMarkerPlace = kPoseTypes.size() - 1;
static_assert(kPoseTypes[kMarkerPlace] == wire::PointPositions::kType);

/// Makes poses of one character from its datagrams.
class CharacterFeed {
public:
    CharacterFeed(const PoseSource& source, std::size_t place, PoseContent content, log::Duration wait)
        : m_source(source),
          m_place(place),
          m_content(content),
          m_order(wait,
                  [this](HeldSample&& sample, bool beginsRun) { release(std::move(sample), beginsRun); }),
          m_key(source.characters[place].parts.front().key) {}

    /// The source was updated: the character is at this place of it now.
    void moveTo(std::size_t place) {
        m_place = place;
        const auto found = std::ranges::find(character().parts, m_key, &PoseCharacter::Part::key);
        m_part = found == character().parts.end()
                     ? 0
                     : static_cast<std::size_t>(found - character().parts.begin());
    }

    void take(const log::Packet& packet, const wire::Header& header, std::size_t part, const TakePose& to) {
        const auto found = std::ranges::find(kPoseTypes, header.type());
        const auto place = static_cast<std::size_t>(found - kPoseTypes.begin());
        const bool isRead =
            m_content == PoseContent::Markers ? place == kMarkerPlace : found != kPoseTypes.end();
        if (!isRead) {
            return;
        }
        m_to = &to;
        if (part != m_part) {
            m_order.flush();
            m_part = part;
            m_key = character().parts[part].key;
            m_newestWhole = {};
        }
        if (m_content == PoseContent::Segments && isBetterSent(place, packet.stamp)) {
            return;
        }
        if (wire::decodeInto(packet.bytes, m_datagram)) {
            if (character().parts[part].isUnframed[place]) {
                m_datagram.header.markLast();
            }
            if (character().parts[part].up == model::UpAxis::Y) {
                model::turnBodyTo(model::UpAxis::Z, m_datagram.body);
            }
            m_order.add(place, m_datagram, packet);
        }
    }
    void release(log::Stamp now, const TakePose& to) {
        m_to = &to;
        m_order.release(now);
    }
    void finish(const TakePose& to) {
        m_to = &to;
        m_order.flush();
    }

private:
    /// Whether poses of a more telling type are on the air: choosePose takes these, so others need no
    /// decoding.
    bool isBetterSent(std::size_t place, log::Stamp stamp) {
        if (place < m_newestWhole.size()) {
            m_newestWhole[place] = stamp;
        }
        const auto better = std::span(m_newestWhole).first(std::min(place, m_newestWhole.size()));
        return std::ranges::any_of(
            better, [&](const auto& newest) { return newest && stamp - *newest <= kSentTogether; });
    }

    void release(HeldSample&& sample, bool beginsRun) {
        m_sample.beginsRun = m_sample.beginsRun || beginsRun;
        if (beginsRun || sample.hasWholePose()) {
            m_recent.clear();
        }
        m_recent.push_back(std::move(sample));
        if (m_content == PoseContent::Markers ? readMarkers() : readPose()) {
            m_sample.character = m_place;
            (*m_to)(m_sample);
            m_sample.beginsRun = false;
        }
        while (m_recent.size() > kRecent &&
               m_recent.front().stamp() + kSentTogether < m_recent.back().stamp()) {
            m_recent.pop_front();
        }
    }

    [[nodiscard]] const PoseCharacter::Part& part() const { return character().parts[m_part]; }
    [[nodiscard]] const PoseCharacter& character() const { return m_source.characters[m_place]; }

    bool readMarkers() {
        const model::Message* message = m_recent.back().message(kMarkerPlace);
        if (message == nullptr) {
            return false;
        }
        const wire::Header& header = message->datagram.header;
        model::CharacterPose& pose = m_sample.pose;
        pose.stamp = message->stamp;
        pose.packet = message->packet;
        pose.type = header.type();
        pose.sample = header.sampleCounter;
        pose.timeCode = header.timeCode;
        m_sample.markers.clear();
        for (const wire::Point& point : std::get<wire::PointPositions>(message->datagram.body).points) {
            const Eigen::Vector3d position = model::pointFromYUp(point.position, part().units[kMarkerPlace]);
            if (position.allFinite()) {
                m_sample.markers.push_back({point.id, position});
            }
        }
        return true;
    }

    /// False if the newest messages make no pose, or one of an earlier sample.
    bool readPose() {
        model::PoseMessages newest{};
        for (auto held = m_recent.rbegin(); held != m_recent.rend(); ++held) {
            for (std::size_t i = 0; i < newest.size(); ++i) {
                newest[i] = newest[i] != nullptr ? newest[i] : held->message(i);
            }
        }
        const model::PoseMessages chosen =
            model::choosePose(newest, [this](log::SenderId, std::size_t place, std::uint32_t number) {
                const auto held = std::ranges::find(m_recent, number, &HeldSample::number);
                return held != m_recent.end() ? held->message(place) : nullptr;
            });
        const model::Message* last = model::newestOf(chosen);
        if (last == nullptr || last->datagram.header.sampleCounter != m_recent.back().number()) {
            return false;
        }
        const auto place = model::rememberingPlace(chosen);
        if (place) {
            std::swap(m_before, m_sample.pose);
        }
        const bool isSame = place && m_placeBefore == place && !m_sample.beginsRun;
        m_placeBefore = place;
        return model::assemble(chosen, part().units, character().bodyAt(last->packet),
                               isSame ? &m_before : nullptr, m_sample.pose);
    }

    const PoseSource& m_source;
    std::size_t m_place;
    PoseContent m_content;
    SampleOrder m_order;
    std::deque<HeldSample> m_recent; ///< that were released, the newest last
    const TakePose* m_to = nullptr;
    PoseSample m_sample;
    model::CharacterPose m_before;            ///< of the sample before
    std::optional<std::size_t> m_placeBefore; ///< in kPoseTypes, if it is to be remembered
    wire::Datagram m_datagram;
    std::size_t m_part = 0;
    model::CharacterKey m_key; ///< of the part
    /// When the newest of each of the whole types came.
    std::array<std::optional<log::Stamp>, model::kWholePoseTypes.size()> m_newestWhole{};
};

/// The newest scale message of a character before a packet; null without one.
const model::NullPose* nullPoseBefore(const model::SessionView& session, const PoseCharacter& character,
                                      std::uint64_t end) {
    for (auto part = character.parts.rbegin(); end != 0 && part != character.parts.rend(); ++part) {
        const model::Character* one = session.roster().find(part->key);
        const bool isSent = one != nullptr && one->nullPoses != nullptr;
        if (const model::NullPose* pose = isSent ? one->nullPoses->at(end - 1) : nullptr) {
            return pose;
        }
    }
    return nullptr;
}

/// All bodies that scale messages before a packet tell of; those after it if there are none.
std::vector<PoseBody> bodiesOf(const model::SessionView& session, const PoseCharacter& character,
                               std::uint64_t end) {
    std::vector<PoseBody> bodies;
    for (const PoseCharacter::Part& part : character.parts) {
        if (const model::Character* one = session.roster().find(part.key); one != nullptr && one->nullPoses) {
            one->nullPoses->forEach([&](std::uint64_t firstPacket, const model::NullPose& pose) {
                bodies.push_back({firstPacket, model::bodyOf(pose)});
            });
        }
    }
    std::ranges::stable_sort(bodies, {}, &PoseBody::firstPacket);
    const auto later = std::ranges::lower_bound(bodies, end, {}, &PoseBody::firstPacket);
    if (later != bodies.begin()) {
        bodies.erase(later, bodies.end());
    }
    const model::BodyOrigins& known = session.messages().bodyOrigins(character.key);
    if (bodies.empty()) {
        bodies.push_back({0, known});
    }
    for (PoseBody& body : bodies) {
        body.origins.bends = known.bends;
    }
    return bodies;
}

PoseCharacter::Part partOf(const model::SessionView& session, const model::CharacterKey& key) {
    PoseCharacter::Part part{.key = key, .up = session.roster().up(key.sender)};
    if (const model::Sender* sender = session.roster().find(key.sender)) {
        std::ranges::transform(model::kPoseTypes, part.units.begin(),
                               [sender](std::uint8_t type) { return sender->positionUnit(type); });
    }
    std::ranges::transform(model::kPoseTypes, part.isUnframed.begin(), [&](std::uint8_t type) {
        const model::Stream* stream = session.roster().find(log::StreamKey{key.sender, key.character, type});
        return stream != nullptr && stream->accounting.framing().isUnmarked();
    });
    const log::StreamKey timeOfDay{key.sender, key.character, wire::TimeCode::kType};
    part.sendsTimeOfDay = session.roster().find(timeOfDay) != nullptr;
    return part;
}

} // namespace

struct PoseFeed::Parts {
    struct Place {
        std::size_t character;
        std::size_t part;
    };

    Parts(PoseSource from, PoseContent what, log::Duration most)
        : content(what), wait(most), source(std::move(from)), follower(*source.log, source.firstPacket) {
        setCharacters(std::exchange(source.characters, {}));
    }

    /// Replaces the characters; those that stay keep the samples that wait.
    void setCharacters(std::vector<PoseCharacter> characters) {
        auto before = std::exchange(feeds, {});
        const auto placesBefore = std::exchange(places, {});
        source.characters = std::move(characters);
        for (std::size_t i = 0; i < source.characters.size(); ++i) {
            std::unique_ptr<CharacterFeed> one;
            const std::vector<PoseCharacter::Part>& parts = source.characters[i].parts;
            for (std::size_t part = 0; part < parts.size(); ++part) {
                const auto found = placesBefore.find(parts[part].key);
                if (found != placesBefore.end() && one == nullptr) {
                    one = std::move(before[found->second.character]);
                }
                places.emplace(parts[part].key, Place{i, part});
            }
            if (one == nullptr) {
                one = std::make_unique<CharacterFeed>(source, i, content, wait);
            }
            one->moveTo(i);
            feeds.push_back(std::move(one));
        }
    }

    void read(const log::Packet& packet, const TakePose& take) {
        if (packet.flags.skipped || packet.bytes.size() > model::kMostMessageBytes) {
            return;
        }
        const auto header = wire::decodeHeader(packet.bytes);
        const auto place = header ? places.find({packet.sender, header->character}) : places.end();
        if (place != places.end()) {
            feeds[place->second.character]->take(packet, *header, place->second.part, take);
        }
    }

    PoseContent content;
    log::Duration wait;
    PoseSource source;
    std::uint64_t known = UINT64_MAX; ///< where the session was that the characters are of
    log::LogFollower follower;
    std::unordered_map<model::CharacterKey, Place> places;
    std::vector<std::unique_ptr<CharacterFeed>> feeds;
    bool isFinished = false;
};

PoseFeed::PoseFeed(PoseSource source, PoseContent content, log::Duration wait)
    : m_parts(std::make_unique<Parts>(std::move(source), content, wait)) {}

PoseFeed::~PoseFeed() = default;

void PoseFeed::update(PoseSource newest) {
    m_parts->known = newest.endPacket;
    m_parts->setCharacters(std::move(newest.characters));
}

const PoseCharacter& PoseFeed::characterOf(const PoseSample& sample) const {
    return m_parts->source.characters[sample.character];
}

bool PoseFeed::advance(const TakePose& take, log::Stamp now) {
    if (m_parts->isFinished) {
        return false;
    }
    const std::uint64_t end = m_parts->source.endPacket;
    m_parts->follower.refresh();
    std::uint64_t count = 0;
    for (; count < kPacketsAtOnce; ++count) {
        const auto packet = m_parts->follower.next(std::min(end, m_parts->known));
        if (!packet) {
            break;
        }
        m_parts->read(*packet, take);
    }
    m_parts->isFinished = m_parts->follower.position() >= end;
    for (const auto& one : m_parts->feeds) {
        if (m_parts->isFinished) {
            one->finish(take);
        } else {
            one->release(now, take);
        }
    }
    return count != 0 || m_parts->isFinished;
}

double PoseFeed::share() const {
    const PoseSource& source = m_parts->source;
    return source.endPacket <= source.firstPacket
               ? 1
               : std::min(1.0, static_cast<double>(m_parts->follower.position() - source.firstPacket) /
                                   static_cast<double>(source.endPacket - source.firstPacket));
}

std::uint64_t PoseFeed::missed() const {
    const log::LogFollower& follower = m_parts->follower;
    const std::uint64_t after =
        follower.position() - std::min(follower.position(), m_parts->source.endPacket);
    return follower.overtaken() - after; // of what lies behind the range
}

const model::BodyOrigins& PoseCharacter::bodyAt(std::uint64_t packet) const {
    const auto later = std::ranges::upper_bound(bodies, packet, {}, &PoseBody::firstPacket);
    return later == bodies.begin() ? bodies.front().origins : std::prev(later)->origins;
}

PoseSource poseSourceOf(const model::SessionView& session, const model::TimeRange& range,
                        std::span<const model::CharacterKey> characters) {
    PoseSource source{&session.log(), session.packetFrom(range.from), session.packetFrom(range.to), {}};
    for (const model::CharacterKey& key : characters) {
        if (session.roster().find(key) == nullptr) {
            continue;
        }
        PoseCharacter& character = source.characters.emplace_back();
        character.key = key;
        character.name = session.roster().displayName(key);
        const model::Sender* sender = session.roster().find(key.sender);
        character.hasReceipt = sender == nullptr || sender->info.transport != log::Transport::File;
        character.colour = session.roster().colour(key);
        for (const model::Character* one : session.roster().lineage(key)) {
            character.parts.push_back(partOf(session, one->key));
        }
        character.remark = session.messages().poseRemark(key);
        character.bodies = bodiesOf(session, character, source.endPacket);
        const model::NullPose* pose = nullPoseBefore(session, character, source.endPacket);
        pose = pose != nullptr ? pose : nullPoseBefore(session, character, session.end());
        character.nullPose = pose != nullptr ? std::optional(*pose) : std::nullopt;
    }
    return source;
}

} // namespace posewire::feed
