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

/// Triangles of half the body in the low detail, and how far its surface may move, metres.
constexpr std::size_t kLowTriangles = 2000;
constexpr float kLowError = 0.02F;

/// Step of the lattice in metres, so fine that no two sheets of the surface share a cell's edge. The low
/// detail is made out of the medium one, since a coarser lattice would fuse fingers.
double latticeStep(Detail detail) {
    return detail == Detail::High ? 0.0135 : 0.0219;
}

/// The same surface in fewer triangles between some of its points. Its rim stays as it is, so that the halves
/// still close.
TriangleSurface simplified(const TriangleSurface& half) {
    const std::vector<glm::vec3> points(half.points.begin(), half.points.end());
    std::vector<unsigned> indices;
    for (const auto& face : half.faces) {
        indices.insert(indices.end(), face.begin(), face.end());
    }
    const float scale = meshopt_simplifyScale(&points[0].x, points.size(), sizeof(glm::vec3));
    indices.resize(meshopt_simplify(indices.data(), indices.data(), indices.size(), &points[0].x,
                                    points.size(), sizeof(glm::vec3), 3 * kLowTriangles, kLowError / scale,
                                    meshopt_SimplifyLockBorder));
    TriangleSurface low;
    constexpr auto kUnused = static_cast<std::uint32_t>(-1);
    std::vector<std::uint32_t> place(points.size(), kUnused);
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        // A face within the mirror plane and its image would lie on each other: without them the rim is
        // shorter by a point, and the same on both sides.
        if (isOnMirrorPlane(half.points[indices[i]]) && isOnMirrorPlane(half.points[indices[i + 1]]) &&
            isOnMirrorPlane(half.points[indices[i + 2]])) {
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& index = place[indices[i + k]];
            if (index == kUnused) {
                index = static_cast<std::uint32_t>(low.points.size());
                low.points.push_back(half.points[indices[i + k]]);
            }
        }
        low.faces.push_back({place[indices[i]], place[indices[i + 1]], place[indices[i + 2]]});
    }
    return low;
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
    const TriangleSurface half = triangulated(quads);
    SkinnedMesh mesh = Assembly(body, detail == Detail::Low ? simplified(half) : half).take();
    orderForDrawing(mesh);
    return mesh;
}

} // namespace posewire::render::mannequin
