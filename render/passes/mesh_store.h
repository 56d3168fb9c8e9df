// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/vertex_array.h"
#include "render/picking.h"
#include "render/scene.h"

#include <array>
#include <optional>
#include <vector>

namespace posewire::render {

/// A mesh on the graphics side, with what the passes ask about its shape.
struct GpuMesh {
    gl::VertexArray array;
    gl::Buffer vertices;
    gl::Buffer indices;
    int indexCount = 0;
    int vertexCount = 0;
    bool hasSuit = false;
    /// Null-pose box of the vertices that each joint moves noticeably.
    std::array<Bounds, kJointCount> jointBoxes;
    SegmentCapsules capsules;
    /// The mesh's own number of each vertex in `vertices`, which are in the order of their use.
    std::vector<std::uint32_t> originalVertices;

    void draw() const;
};

class MeshStore {
public:
    MeshId add(const SkinnedMesh& mesh, std::span<const glm::vec3> templatePositions);
    bool replace(MeshId id, const SkinnedMesh& mesh, std::span<const glm::vec3> templatePositions);
    void remove(MeshId id);
    /// Null where there is none.
    const GpuMesh* find(MeshId id) const;

private:
    /// MeshId n is at n − 1.
    std::vector<std::optional<GpuMesh>> m_meshes;
};

/// Triangles in an order that uses a vertex again soon after its first use, so that it is skinned once:
/// "Tipsify" of Sander, Nehab and Barczak, "Fast Triangle Reordering for Vertex Locality and Reduced
/// Overdraw", 2007.
std::vector<std::uint32_t> orderForVertexReuse(std::span<const std::uint32_t> indices,
                                               std::size_t vertexCount);

} // namespace posewire::render
