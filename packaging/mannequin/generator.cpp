// SPDX-License-Identifier: MIT
#include "packaging/mannequin/generator.h"

#include "packaging/mannequin/half_surface.h"
#include "packaging/mannequin/weights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <meshoptimizer.h>

namespace posewire::render::mannequin {
namespace {

/// Step of the lattice in metres, so fine that no two sheets of the surface share a cell's edge.
double latticeStep(Detail detail) {
    return detail == Detail::High ? 0.013 : 0.022;
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

template <typename Element>
void renumber(std::vector<Element>& elements, const std::vector<unsigned>& newIndex) {
    meshopt_remapVertexBuffer(elements.data(), elements.data(), elements.size(), sizeof(Element),
                              newIndex.data());
}

/// Puts triangles that share vertices close together, and vertices in the order of their first use: graphics
/// processors and software alike then skin each vertex about once.
void orderForDrawing(SkinnedMesh& mesh) {
    const std::size_t count = mesh.vertexCount();
    unsigned* indices = mesh.indices.data();
    meshopt_optimizeVertexCache(indices, indices, mesh.indices.size(), count);
    std::vector<unsigned> newIndex(count);
    meshopt_optimizeVertexFetchRemap(newIndex.data(), indices, mesh.indices.size(), count);
    meshopt_remapIndexBuffer(indices, indices, mesh.indices.size(), newIndex.data());
    renumber(mesh.positions, newIndex);
    renumber(mesh.normals, newIndex);
    renumber(mesh.occlusion, newIndex);
    renumber(mesh.joints, newIndex);
    renumber(mesh.weights, newIndex);
}

} // namespace

SkinnedMesh generate(Detail detail) {
    const Body body;
    QuadSurface quads = extractSurface(body, latticeStep(detail));
    relaxOntoSurface(body, quads);
    SkinnedMesh mesh = Assembly(body, triangulated(quads)).take();
    orderForDrawing(mesh);
    return mesh;
}

} // namespace posewire::render::mannequin
