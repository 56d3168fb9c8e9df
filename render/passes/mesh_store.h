// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/texture.h"
#include "render/gl/vertex_array.h"
#include "render/picking.h"
#include "render/scene.h"

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
    std::vector<Bounds> jointBoxes;
    SegmentCapsules capsules;
    /// Of a user's own character; else empty.
    std::vector<MeshPart> parts;
    gl::Buffer texturePlaces;
    std::vector<gl::Texture> textures;

    void draw() const;
    void draw(const MeshPart& part) const;
};

class MeshStore {
public:
    MeshId add(const SkinnedMesh& mesh, std::span<const glm::vec3> templatePositions);
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
