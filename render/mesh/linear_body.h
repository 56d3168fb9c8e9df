// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/null_pose_fit.h"
#include "render/skinning.h"

#include <string>
#include <vector>

namespace posewire::render {

/// A joint of a body for programs that blend matrices instead of dual quaternions.
struct LinearJoint {
    /// "RightForeArm" of a segment, "RightForeArm bend 2" of one that segments do not have.
    std::string name;
    /// The joint, below kJointCount, of the segment or finger segment that it is or moves with.
    std::size_t segment = 0;
    bool isSegment = true;
    /// Its origin leaves that of its segment: flesh of the shoulder gives way.
    bool isShifted = false;
    glm::vec3 origin{}; ///< null pose, metres
    /// Its motion is the blend of these joints of the palette, `to` weighing `share`.
    std::size_t from = 0;
    std::size_t to = 0;
    float share = 0.0F;
};

/// The mannequin on a performer's body with joints of its own between those of the window: matrices that are
/// blended over a small angle keep the form that dual quaternions keep over a large one.
struct LinearBody {
    SkinnedMesh mesh; ///< its joints are places in `joints`
    std::vector<LinearJoint> joints;
};

/// Hands whose fingers are not sent have no joints: they are at rest, as PaletteJob has it.
LinearBody linearBody(const SkinnedMesh& mannequin, const BodyFit& fit, bool hasLeftFingers,
                      bool hasRightFingers);

/// The place of a joint in a palette that PaletteJob made with the origins of the body's fit.
struct LinearPlace {
    glm::vec3 position{};                          ///< of its origin, world, metres
    glm::quat orientation{1.0F, 0.0F, 0.0F, 0.0F}; ///< world
};
LinearPlace placeOf(const LinearJoint& joint, std::span<const DualQuaternion> palette);

} // namespace posewire::render
