// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/texture.h"
#include "render/gl/vertex_array.h"
#include "render/picking.h"
#include "render/scene.h"

#include <optional>
#include <vector>

namespace posewire::render {

/// Where a mesh's positions lie, which are kept as shares of it.
struct Cube {
    glm::vec3 low{0.0F};
    float side = 1.0F;

    bool operator==(const Cube&) const = default;
};

/// A mesh on the graphics side, with what the passes ask about its shape.
struct GpuMesh {
    gl::VertexArray array;
    gl::Buffer vertices;
    gl::Buffer indices;
    int indexCount = 0;
    int vertexCount = 0;
    bool hasSuit = false;
    Cube cube;
    /// By joint.
    std::vector<Segment> segments;
    /// Null-pose box of the vertices that each joint moves noticeably.
    std::vector<Bounds> jointBoxes;
    SegmentCapsules capsules;
    /// Of a user's own character; else empty.
    std::vector<MeshPart> parts;
    gl::Buffer texturePlaces;
    std::vector<gl::Texture> textures;
};

class MeshStore {
public:
    /// The mannequin, in one of its levels.
    MeshId add(const SkinnedMesh& mesh);
    MeshId add(const SkinnedMesh& mesh, const MeshDress& dress);
    void remove(MeshId id);
    /// Null where there is none.
    const GpuMesh* find(MeshId id) const;

private:
    MeshId keep(std::optional<GpuMesh> gpu);

    /// MeshId n is at n − 1; a place that is free is used again.
    std::vector<std::optional<GpuMesh>> m_meshes;
};

} // namespace posewire::render
