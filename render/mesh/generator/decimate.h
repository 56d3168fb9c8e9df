// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/generator/half_surface.h"

namespace posewire::render::mannequin {

/// Collapses edges in the order of quadric error (Garland and Heckbert 1997) until the half has `faceCount`
/// faces or no edge is left that may go. The surface stays a manifold, its rim stays in the mirror plane, and
/// no new edge is longer than `longestEdge` metres: limbs keep enough rings to bend.
TriangleSurface decimated(const TriangleSurface& surface, std::size_t faceCount, double longestEdge);

} // namespace posewire::render::mannequin
