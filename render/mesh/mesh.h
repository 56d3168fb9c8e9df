// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <tl/expected.hpp>

namespace posewire::render {

/// Bytes of each vertex on the graphics side.
inline constexpr std::size_t kGpuVertexBytes = 28;

/// Up to four joints per vertex; unused places have joint 0 and weight 0.
using JointIndices = std::array<std::uint8_t, 4>;

/// A triangle mesh in its bind pose, on the CPU. All vertex arrays have one entry per vertex.
/// Metres, Z-up, X forward, Y left; triangles are counter-clockwise seen from outside.
struct SkinnedMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    /// Baked ambient light: 1 is open, 0 is closed.
    std::vector<float> occlusion;
    /// 0..22 are segments (MVN's ID − 1), the others follow them: see joints.h.
    std::vector<JointIndices> joints;
    /// Not negative, sum 1, falling from x to w.
    std::vector<glm::vec4> weights;
    /// Three per triangle.
    std::vector<std::uint32_t> indices;

    std::size_t vertexCount() const { return positions.size(); }
    std::size_t triangleCount() const { return indices.size() / 3; }

    /// What makes the mesh unfit to draw: array sizes that disagree, indices out of range, numbers that are
    /// not finite, weights that do not sum to 1 within 1e-4. `jointCount` bounds the joint indices.
    tl::expected<void, std::string> validate(std::size_t jointCount) const;
};

} // namespace posewire::render
