// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/body/character_pose.h"
#include "core/model/session/session_view.h"

#include <array>
#include <cstdint>
#include <optional>

/// What other messages tell of a character beside the pose that is shown.
namespace posewire::gui {

/// A character as it is shown.
struct PoseSubject {
    model::SessionView& session;
    model::CharacterKey key;
    const model::CharacterPose& pose;
};

/// The newest message of the subject's character, where it is not older than its pose by more than types that
/// are sent together are; null for none. Positions of it are to be moved as the pose was.
[[nodiscard]] const model::Message* freshMessage(const PoseSubject& subject, std::uint8_t type);
/// The same as the body of that message.
template <class Body>
[[nodiscard]] const Body* freshBody(const PoseSubject& subject) {
    const model::Message* message = freshMessage(subject, Body::kType);
    return message != nullptr ? std::get_if<Body>(&message->datagram.body) : nullptr;
}
/// Of positions in messages of a type.
[[nodiscard]] model::LengthUnit unitOf(const PoseSubject& subject, std::uint8_t type);

/// The joint between a body segment and its parent.
struct JointReading {
    std::array<double, 3> degrees{}; ///< abduction, axial rotation, flexion
    bool isSent = false;             ///< in type 20; else from the orientations of the pose
};
/// Nothing for the pelvis and for what is not of the body.
[[nodiscard]] std::optional<JointReading> jointReading(const PoseSubject& subject, int segment);

} // namespace posewire::gui
