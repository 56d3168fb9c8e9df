// SPDX-License-Identifier: MIT
#include "core/model/session/null_pose_evidence.h"

#include "core/log/time.h"
#include "core/model/body/character_pose.h"
#include "core/model/session/message.h"
#include "core/model/session/session_view.h"

#include <algorithm>

namespace posewire::model {

NullPoseEvidence nullPoseEvidence(const SessionView& session, const CharacterKey& key) {
    NullPoseEvidence evidence;
    evidence.now = session.cursorStamp();
    const std::uint64_t newest = session.end() == 0 ? 0 : session.end() - 1;
    const std::uint64_t visible =
        session.cursor().mode == Cursor::Mode::Paused ? std::min(session.cursor().packet, newest) : newest;
    for (const Character* character = session.find(key);
         character != nullptr && evidence.record.messages == 0;
         character = session.predecessor(character->key)) {
        if (const NullPoseHistory* history = session.nullPoses(character->key)) {
            evidence.record = history->record(visible);
        }
    }
    if (const Message* message = session.message(key, wire::ScaleInformation::kType)) {
        evidence.scale = std::get_if<wire::ScaleInformation>(&message->datagram.body);
    }
    if (const CharacterPose* pose = session.pose(key)) {
        evidence.layout = pose->layout;
        if (const Stream* stream = session.find(log::StreamKey{key.sender, key.character, pose->type})) {
            evidence.poseSeconds = log::secondsOf(pose->stamp - stream->accounting.firstStamp());
        }
    }
    return evidence;
}

} // namespace posewire::model
