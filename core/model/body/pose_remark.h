// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/character_pose.h"

#include <string>
#include <vector>

namespace posewire::model {

/// What is to be said of a pose that was not sent as it is shown: the one place for these words.
struct PoseRemark {
    /// Something of it rests on nothing that was sent, or on a scale message that contradicts it: it is not
    /// to be called good.
    bool isAssumed = false;
    std::string reason; ///< why it is assumed: one of the lines
    std::string brief;  ///< "assumed", "solved", "2 objects"; empty where there is nothing to say
    /// What is missing and what is shown instead, in sentences without a stop at the end.
    std::vector<std::string> lines;

    [[nodiscard]] bool isEmpty() const { return lines.empty(); }
};

/// Whether a body reaches below the floor, as recordings without one do: there the pelvis is at z = 0.
[[nodiscard]] bool isBelowFloor(const CharacterPose& pose);

/// How large a body is between its joints that were sent, against `body`, in steps of 2 %; 1 where the joints
/// are those of `body`, as they are unless the scale message is of somebody else.
[[nodiscard]] double scaleInPose(const CharacterPose& pose, const BodyOrigins& body);

[[nodiscard]] PoseRemark remarkOn(const CharacterPose& pose, const BodyOrigins& body);

} // namespace posewire::model
