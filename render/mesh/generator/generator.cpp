// SPDX-License-Identifier: MIT
#include "render/mesh/generator/generator.h"

#include "render/mesh/generator/decimate.h"
#include "render/mesh/generator/half_surface.h"
#include "render/mesh/generator/weights.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace posewire::render::mannequin {
namespace {

/// Faces are looked at more closely than anything else.
double importanceAt(const glm::dvec3& point) {
    return 1.0 + 24.0 * smoothstep(1.48, 1.56, point.z) * smoothstep(-0.02, 0.04, point.x);
}

struct Recipe {
    /// Of the lattice, metres. Chosen so that no two sheets of the surface share a cell's edge.
    double step;
    /// No faces: the surface stays as it was extracted.
    DecimationTarget target{};
};

Recipe recipeOf(Detail detail) {
    switch (detail) {
    case Detail::Low:
        return {0.013, {2000, 0.055, importanceAt}};
    case Detail::Medium:
        return {0.022};
    case Detail::High:
        break;
    }
    return {0.013};
}

/// Ambient light by probing the field along the normal; in steps of 1/255, as it is stored.
float occlusionAt(const Body& body, const glm::dvec3& point, const glm::dvec3& normal) {
    constexpr std::array<double, 4> kProbes{0.008, 0.020, 0.045, 0.090};
    double open = 1.0;
    double share = 0.55;
    for (const double height : kProbes) {
        open -= share * std::max(height - body.distance(point + normal * height), 0.0) / height;
        share /= 2.0;
    }
    return static_cast<float>(std::round(std::clamp(open, 0.25, 1.0) * 255.0) / 255.0);
}

/// The halves as one mesh: the left half's vertices, then the mirror images of those that are not in the
/// mirror plane.
class Assembly {
public:
    Assembly(const Body& body, const TriangleSurface& half) {
        for (const glm::dvec3& point : half.points) {
            const glm::dvec3 normal = surfaceNormal(body, point);
            addVertex(point, normal, occlusionAt(body, point, normal), influencesAt(point));
        }
        std::vector<std::uint32_t> image(half.points.size());
        for (std::uint32_t i = 0; i < half.points.size(); ++i) {
            image[i] = isOnMirrorPlane(half.points[i]) ? i : addImage(i);
        }
        for (const auto& [a, b, c] : half.faces) {
            m_mesh.indices.insert(m_mesh.indices.end(), {a, b, c});
        }
        for (const auto& [a, b, c] : half.faces) {
            m_mesh.indices.insert(m_mesh.indices.end(), {image[a], image[c], image[b]});
        }
    }

    SkinnedMesh take() { return std::move(m_mesh); }

private:
    void addVertex(const glm::vec3& position, const glm::vec3& normal, float occlusion,
                   const Influences& influences) {
        m_mesh.positions.push_back(position);
        m_mesh.normals.push_back(normal);
        m_mesh.occlusion.push_back(occlusion);
        m_mesh.joints.push_back(influences.joints);
        m_mesh.weights.push_back(influences.weights);
    }

    std::uint32_t addImage(std::uint32_t i) {
        const auto index = static_cast<std::uint32_t>(m_mesh.vertexCount());
        const glm::vec3 flip(1.0F, -1.0F, 1.0F);
        addVertex(m_mesh.positions[i] * flip, m_mesh.normals[i] * flip, m_mesh.occlusion[i],
                  mirrored({m_mesh.joints[i], m_mesh.weights[i]}));
        return index;
    }

    SkinnedMesh m_mesh;
};

} // namespace

SkinnedMesh generate(Detail detail) {
    const Body body;
    const Recipe recipe = recipeOf(detail);
    QuadSurface quads = extractSurface(body, recipe.step);
    relaxOntoSurface(body, quads);
    TriangleSurface half = triangulated(quads);
    if (recipe.target.faceCount > 0) {
        half = decimated(half, recipe.target);
    }
    return Assembly(body, half).take();
}

} // namespace posewire::render::mannequin
