// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/generator/half_surface.h"

namespace posewire::render::mannequin {

struct DecimationTarget {
    std::size_t faceCount = 0;
    /// No new edge is longer, metres: limbs keep enough rings to bend.
    double longestEdge = 0.0;
    /// How much the error counts at a place.
    double (*importance)(const glm::dvec3& point) = nullptr;
};

/// Collapses edges in the order of quadric error (Garland and Heckbert 1997) until the half has `faceCount`
/// faces or no edge is left that may go. The surface stays a manifold and its rim stays in the mirror plane.
TriangleSurface decimated(const TriangleSurface& surface, const DecimationTarget& target);

} // namespace posewire::render::mannequin
