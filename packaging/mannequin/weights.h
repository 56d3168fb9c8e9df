// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/joints.h"
#include "render/mesh/mesh.h"

namespace posewire::render::mannequin {

struct Influences {
    JointIndices joints{};
    glm::vec4 weights{0.0F};
};

/// Skin weights as a function of the place on the body: the four largest, falling, with sum 1.
/// In the mirror plane the joints of the two sides weigh exactly the same.
Influences influencesAt(const glm::dvec3& point);

/// The influences of the mirror image of a point: left joints become right ones and the other way round.
Influences mirrored(const Influences& influences);

} // namespace posewire::render::mannequin
