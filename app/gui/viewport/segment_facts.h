// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/character_mark.h"
#include "app/gui/theme/theme.h"
#include "core/model/body/character_pose.h"
#include "core/model/message.h"
#include "core/model/session/session_view.h"

#include <QString>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

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
[[nodiscard]] model::LengthUnit unitOf(const PoseSubject& subject, std::uint8_t type);

/// The joint between a body segment and its parent.
struct JointReading {
    std::array<double, 3> degrees{}; ///< abduction, axial rotation, flexion
    bool isSent = false;             ///< in type 20; else from the orientations of the pose
};
/// Nothing for the pelvis and for what is not of the body.
[[nodiscard]] std::optional<JointReading> jointReading(const PoseSubject& subject, int segment);

/// A quantity of a segment: w x y z, of which vectors leave w empty and plain numbers have x alone.
struct SegmentFact {
    QString name;
    std::array<QString, 4> values;
    QString unit;

    friend bool operator==(const SegmentFact&, const SegmentFact&) = default;
};

struct SegmentFacts {
    CharacterMark mark;
    QString segment;
    QString character;
    QString source; ///< "Position sent, orientation solved"
    Health sourceHealth = Health::Unknown;
    std::vector<SegmentFact> facts;

    friend bool operator==(const SegmentFacts&, const SegmentFacts&) = default;
};

/// Pose, motion (types 21 and 22) and joint (type 20, else from the pose) of a segment by its position in
/// pose datagrams, in the world as it was sent: metres, seconds, radians, joints in degrees. `segment` is
/// within the pose.
[[nodiscard]] SegmentFacts segmentFacts(const PoseSubject& subject, int segment);

} // namespace posewire::gui
