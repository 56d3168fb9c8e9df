// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace posewire::render {

/// Area-weighted vertex normals of unit length. A vertex without area keeps (0, 0, 1).
inline void computeNormals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                           std::span<glm::vec3> normals) {
    std::fill(normals.begin(), normals.end(), glm::vec3(0.0F));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec3& a = positions[indices[i]];
        const glm::vec3 area = glm::cross(positions[indices[i + 1]] - a, positions[indices[i + 2]] - a);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            normals[indices[i + corner]] += area;
        }
    }
    for (glm::vec3& normal : normals) {
        const float length = glm::length(normal);
        normal = length > 0.0F ? normal / length : glm::vec3(0.0F, 0.0F, 1.0F);
    }
}

} // namespace posewire::render
