// SPDX-License-Identifier: MIT
#include "core/feed/pose_source.h"

#include "core/model/body/null_pose_measures.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <algorithm>

namespace posewire::feed {
namespace {

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
    if (bodies.empty()) {
        bodies.push_back({0, session.messages().bodyOrigins(character.key)});
    }
    return bodies;
}

PoseCharacter::Part partOf(const model::SessionView& session, const model::CharacterKey& key) {
    PoseCharacter::Part part{key};
    if (const model::Sender* sender = session.roster().find(key.sender)) {
        std::ranges::transform(model::kPoseTypes, part.units.begin(),
                               [sender](std::uint8_t type) { return sender->positionUnit(type); });
    }
    return part;
}

} // namespace

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
