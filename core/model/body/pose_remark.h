// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/character_pose.h"
#include "core/words/fact.h"

#include <vector>

namespace posewire::model {

struct PoseRemark {
    /// Something of it rests on nothing that was sent, or on a scale message that contradicts it: it is not
    /// to be called good.
    bool isAssumed = false;
    words::Fact reason;             ///< why it is assumed: one of the lines
    words::Fact brief;              ///< "partly assumed", "2 objects"; nothing if there is nothing to say
    std::vector<words::Fact> lines; ///< what is missing and what is shown instead

    [[nodiscard]] bool isEmpty() const { return lines.empty(); }
};

/// Whether a body reaches below the floor, as recordings without one do: there the pelvis is at z = 0.
[[nodiscard]] bool isBelowFloor(const CharacterPose& pose);

/// How large a body is between its joints that were sent, against `body`, in steps of 2 %; 1 if the joints
/// are those of `body`, as they are unless the scale message is of somebody else.
[[nodiscard]] double scaleInPose(const CharacterPose& pose, const BodyOrigins& body);

[[nodiscard]] PoseRemark remarkOn(const CharacterPose& pose, const BodyOrigins& body);

} // namespace posewire::model
