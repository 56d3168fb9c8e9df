// SPDX-License-Identifier: MIT
#pragma once

#include "render/skinning.h"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace posewire::render::test {

/// A pose in the world, for the null pose it was made with.
struct Pose {
    std::array<glm::vec3, kSegmentCount> positions;
    std::array<glm::quat, kSegmentCount> orientations;
};

/// Rotations against the parent; segments that are not named have none.
using LocalRotations = std::vector<std::pair<Segment, glm::quat>>;

/// Forward kinematics with the pelvis where the null pose has it.
Pose poseFrom(const LocalRotations& rotations, const NullPose& nullPose = kReferenceNullPose);

Pose tPose();
Pose standingPose();
Pose lungePose();
Pose squatPose();
/// Elbows bent at right angles, one arm up, the trunk turned, knees bent.
Pose elbowPose();
/// Shoulders drawn up, arms down.
Pose shrugPose();
Pose raisedArmsPose();
/// On a chair: hips and knees at 90°.
Pose sittingPose();
/// Each leg 70° to its side.
Pose spreadLegsPose();
Pose nodPose();

/// Moves the pose by `offset` and turns it about the vertical (radians).
Pose placed(const Pose& pose, const glm::vec3& offset, float turn = 0.0F);

std::vector<DualQuaternion> paletteOf(const Pose& pose, const NullPose& nullPose = kReferenceNullPose);

/// The palette of a pose whose hands are closed.
std::vector<DualQuaternion> fist(const Pose& pose);

/// Puts the lowest vertex of the skinned mesh on the floor.
Pose grounded(const Pose& pose, const SkinnedMesh& mesh, const NullPose& nullPose = kReferenceNullPose);

} // namespace posewire::render::test
