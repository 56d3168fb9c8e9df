// SPDX-License-Identifier: MIT
#include "packaging/mannequin/half_surface.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace posewire::render::mannequin {
namespace {

constexpr double kProjectionStep = 5e-4;
constexpr double kNormalStep = 1.5e-3;
constexpr double kLongestMove = 0.004;
constexpr double kSmoothing = 0.55;
constexpr int kRounds = 6;

/// Sums of the neighbours' places, with the mirror image's neighbours counted at the rim.
struct Neighbourhood {
    glm::dvec3 sum{0.0};
    double count = 0.0;
};

void addNeighbour(Neighbourhood& around, const glm::dvec3& centre, const glm::dvec3& neighbour) {
    if (!isOnMirrorPlane(centre)) {
        around.sum += neighbour;
        around.count += 1.0;
    } else if (isOnMirrorPlane(neighbour)) {
        // An edge in the rim borders one face here and one in the mirror image: it is visited once and counts
        // twice.
        around.sum += 2.0 * neighbour;
        around.count += 2.0;
    } else {
        around.sum += 2.0 * glm::dvec3(neighbour.x, 0.0, neighbour.z);
        around.count += 2.0;
    }
}

std::vector<Neighbourhood> neighbourhoods(const QuadSurface& surface) {
    std::vector<Neighbourhood> around(surface.points.size());
    for (const auto& face : surface.faces) {
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t a = face[i];
            const std::uint32_t b = face[(i + 1) % face.size()];
            addNeighbour(around[a], surface.points[a], surface.points[b]);
            addNeighbour(around[b], surface.points[b], surface.points[a]);
        }
    }
    return around;
}

void smoothAlongSurface(const Body& body, QuadSurface& surface) {
    const std::vector<Neighbourhood> around = neighbourhoods(surface);
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        glm::dvec3& point = surface.points[i];
        const glm::dvec3 normal = glm::normalize(body.gradient(point, kProjectionStep));
        const glm::dvec3 pull = around[i].sum / around[i].count - point;
        point = projected(body, point + kSmoothing * (pull - normal * glm::dot(pull, normal)), 1);
    }
}

} // namespace

glm::dvec3 projected(const Body& body, glm::dvec3 point, int steps) {
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 slope = body.gradient(point, kProjectionStep);
        const double steepness = glm::length(slope);
        const double move = body.distance(point) * steepness / std::max(steepness * steepness, 0.05);
        point -= slope / std::max(steepness, 1e-6) * std::clamp(move, -kLongestMove, kLongestMove);
    }
    return point;
}

glm::dvec3 surfaceNormal(const Body& body, const glm::dvec3& point) {
    return glm::normalize(body.gradient(point, kNormalStep));
}

void relaxOntoSurface(const Body& body, QuadSurface& surface) {
    const auto project = [&] {
        for (glm::dvec3& point : surface.points) {
            point = projected(body, point, 2);
        }
    };
    project();
    for (int round = 0; round < kRounds; ++round) {
        smoothAlongSurface(body, surface);
    }
    project();
}

TriangleSurface triangulated(const QuadSurface& surface) {
    TriangleSurface triangles{surface.points, {}};
    for (const auto& [a, b, c, d] : surface.faces) {
        const auto& p = surface.points;
        if (glm::distance(p[a], p[c]) <= glm::distance(p[b], p[d])) {
            triangles.faces.push_back({a, b, c});
            triangles.faces.push_back({a, c, d});
        } else {
            triangles.faces.push_back({a, b, d});
            triangles.faces.push_back({b, c, d});
        }
    }
    return triangles;
}

} // namespace posewire::render::mannequin
