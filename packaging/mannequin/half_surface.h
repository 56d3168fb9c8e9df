// SPDX-License-Identifier: MIT
#pragma once

#include "packaging/mannequin/body.h"

#include <array>
#include <cstdint>
#include <vector>

namespace posewire::render::mannequin {

/// The left half (y ≥ 0) of a surface that is symmetric in y. Its rim lies in the plane y = 0 exactly, so
/// that the half and its mirror image close to a surface that is symmetric to the last bit.
template <std::size_t Corners>
struct HalfSurface {
    std::vector<glm::dvec3> points;
    /// Counter-clockwise seen from outside.
    std::vector<std::array<std::uint32_t, Corners>> faces;
};

using QuadSurface = HalfSurface<4>;
using TriangleSurface = HalfSurface<3>;

inline bool isOnMirrorPlane(const glm::dvec3& point) {
    return point.y == 0.0;
}

/// Surface nets on a lattice of the given step in metres, finer at hands, head and feet: one vertex in each
/// cell that the surface passes, one quad across each lattice edge that changes sign.
QuadSurface extractSurface(const Body& body, double step);

/// Moves the points onto the surface and evens them out along it.
void relaxOntoSurface(const Body& body, QuadSurface& surface);

/// Moves a point along the gradient to the surface, by Newton's method with steps of at most 4 mm.
glm::dvec3 projected(const Body& body, glm::dvec3 point, int steps);

/// Outward unit normal.
glm::dvec3 surfaceNormal(const Body& body, const glm::dvec3& point);

/// Splits each quad along its shorter diagonal.
TriangleSurface triangulated(const QuadSurface& surface);

} // namespace posewire::render::mannequin
