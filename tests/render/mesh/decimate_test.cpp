// SPDX-License-Identifier: MIT
#include "render/mesh/generator/decimate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render::mannequin {
namespace {

double evenly(const glm::dvec3&) {
    return 1.0;
}

/// A closed tube of three-cornered rings along x, clear of the mirror plane: where a neck is three edges
/// round, a collapse across it would pinch it off.
TriangleSurface tube(std::uint32_t rings) {
    TriangleSurface surface;
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const double angle = 2.0 * std::numbers::pi * corner / 3.0;
            surface.points.emplace_back(0.1 * ring, 1.0 + 0.05 * std::cos(angle), 0.05 * std::sin(angle));
        }
    }
    for (std::uint32_t first = 0; first + 3 < 3 * rings; first += 3) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t a = first + corner;
            const std::uint32_t b = first + (corner + 1) % 3;
            surface.faces.push_back({a, b, b + 3});
            surface.faces.push_back({a, b + 3, a + 3});
        }
    }
    const std::uint32_t last = 3 * (rings - 1);
    surface.faces.push_back({0, 2, 1});
    surface.faces.push_back({last, last + 1, last + 2});
    return surface;
}

/// A flat square grid whose edge y = 0 is the rim.
TriangleSurface sheet(std::uint32_t cells) {
    TriangleSurface surface;
    for (std::uint32_t i = 0; i <= cells; ++i) {
        for (std::uint32_t j = 0; j <= cells; ++j) {
            surface.points.emplace_back(0.01 * i, 0.01 * j, 0.0);
        }
    }
    for (std::uint32_t i = 0; i < cells; ++i) {
        for (std::uint32_t j = 0; j < cells; ++j) {
            const std::uint32_t a = i * (cells + 1) + j;
            const std::uint32_t b = a + cells + 1;
            surface.faces.push_back({a, b, b + 1});
            surface.faces.push_back({a, b + 1, a + 1});
        }
    }
    return surface;
}

using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

Edges directedEdges(const TriangleSurface& surface) {
    Edges edges;
    for (const auto& face : surface.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            ++edges[{face[i], face[(i + 1) % 3]}];
        }
    }
    return edges;
}

TEST(Decimate, NeverPinchesATubeOff) {
    const TriangleSurface surface = decimated(tube(12), {4, 10.0, evenly});
    EXPECT_LT(surface.faces.size(), tube(12).faces.size());
    const Edges edges = directedEdges(surface);
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
    EXPECT_EQ(static_cast<long>(surface.points.size() + surface.faces.size()) -
                  static_cast<long>(edges.size() / 2),
              2);
}

TEST(Decimate, StopsAtTheCountAskedFor) {
    const std::size_t count = decimated(sheet(20), {300, 1.0, evenly}).faces.size();
    EXPECT_LE(count, 300U);
    EXPECT_GE(count, 299U);
}

TEST(Decimate, KeepsTheRimInTheMirrorPlaneAndTheRestOutOfIt) {
    const TriangleSurface surface = decimated(sheet(20), {300, 1.0, evenly});
    const Edges edges = directedEdges(surface);
    std::set<std::uint32_t> onOpenSide;
    for (const auto& [edge, count] : edges) {
        if (!edges.contains({edge.second, edge.first}) && surface.points[edge.first].y == 0.0) {
            onOpenSide.insert(edge.first);
        }
    }
    EXPECT_GE(onOpenSide.size(), 2U);
    for (std::uint32_t i = 0; i < surface.points.size(); ++i) {
        ASSERT_GE(surface.points[i].y, 0.0);
        ASSERT_EQ(isOnMirrorPlane(surface.points[i]), onOpenSide.contains(i));
    }
}

TEST(Decimate, MakesNoEdgeLongerThanAsked) {
    const TriangleSurface surface = decimated(sheet(20), {1, 0.045, evenly});
    for (const auto& [edge, count] : directedEdges(surface)) {
        ASSERT_LE(glm::distance(surface.points[edge.first], surface.points[edge.second]), 0.045);
    }
}

} // namespace
} // namespace posewire::render::mannequin
