// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_source.h"

#include "core/model/body/null_pose_measures.h"

namespace posewire::exporting {
namespace {

/// Of the newest part that has sent one.
std::optional<model::NullPose> nullPoseOf(const model::SessionView& session, const MotionCharacter& character,
                                          std::uint64_t endPacket) {
    for (const std::uint64_t end : {endPacket, session.end()}) {
        for (auto part = character.parts.rbegin(); part != character.parts.rend(); ++part) {
            const model::NullPoseHistory* history = session.nullPoses(part->key);
            const model::NullPose* pose = history != nullptr && end != 0 ? history->at(end - 1) : nullptr;
            if (pose != nullptr) {
                return *pose;
            }
        }
    }
    return std::nullopt;
}

MotionCharacter::Part streamPart(const model::SessionView& session, const model::CharacterKey& key) {
    MotionCharacter::Part part{key};
    if (const model::Sender* sender = session.find(key.sender)) {
        for (std::size_t i = 0; i < model::kWholePoseTypes.size(); ++i) {
            part.poseUnits[i] = sender->positionUnit(model::kWholePoseTypes[i]);
        }
        part.markerUnit = sender->positionUnit(kMarkerType);
    }
    return part;
}

} // namespace

MotionSource motionSourceOf(const model::SessionView& session, const model::TimeRange& range,
                            std::span<const model::CharacterKey> characters) {
    MotionSource source{&session.log(), session.packetFrom(range.from), session.packetFrom(range.to), {}};
    for (const model::CharacterKey& key : characters) {
        if (session.find(key) == nullptr) {
            continue;
        }
        MotionCharacter& character = source.characters.emplace_back();
        character.key = key;
        character.name = session.displayName(key);
        const model::Sender* sender = session.find(key.sender);
        character.hasReceipt = sender == nullptr || sender->info.transport != log::Transport::File;
        character.colour = session.colour(key);
        for (const model::Character* one : session.lineage(key)) {
            character.parts.push_back(streamPart(session, one->key));
        }
        character.nullPose = nullPoseOf(session, character, source.endPacket);
        character.body = character.nullPose ? model::bodyOf(*character.nullPose) : session.bodyOrigins(key);
    }
    return source;
}

} // namespace posewire::exporting
