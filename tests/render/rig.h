// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/own_body.h"

namespace posewire::render::test {

/// A character of tubes as another program might have left it: bones by Mixamo's names, three in the spine,
/// arms and legs away from the T-pose.
struct Rig {
    float armsDown = 45.0F;         ///< degrees below level
    float legsApart = 8.0F;         ///< degrees, of each leg
    float feetOut = 12.0F;          ///< degrees
    float palmsAhead = 60.0F;       ///< degrees that hands are turned about the forearm
    float fingersBent = 20.0F;      ///< degrees, of each index finger's bones
    glm::quat fileTurn{1, 0, 0, 0}; ///< of everything, in the file
    float fileUnit = 1.0F;          ///< units in a metre
    float legs = 1.0F;              ///< their length against the reference body's

    ImportedCharacter character() const;
};

/// The place of a mapped segment's joint in a palette of the body.
glm::vec3 placeOf(const OwnBody& body, std::span<const DualQuaternion> palette, Segment segment,
                  float scale = 1.0F);

} // namespace posewire::render::test
