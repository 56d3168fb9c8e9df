// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/joints.h"

#include <array>

#include <glm/vec3.hpp>

namespace posewire::render::mannequin {

/// What part of a point beyond the wrist follows each segment of the left hand; what is left to 1 follows the
/// hand itself. The point is on the left side.
std::array<double, kHandSegmentCount> handShares(const glm::dvec3& point);

} // namespace posewire::render::mannequin
