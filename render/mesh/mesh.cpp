// SPDX-License-Identifier: MIT
#include "render/mesh/mesh.h"

#include "render/mesh/finite.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace posewire::render {
namespace {

bool areWeightsSound(const glm::vec4& weights) {
    float sum = 0.0F;
    for (int i = 0; i < 4; ++i) {
        if (!(weights[i] >= 0.0F)) {
            return false;
        }
        sum += weights[i];
    }
    return std::abs(sum - 1.0F) <= 1e-4F;
}

} // namespace

tl::expected<void, std::string> SkinnedMesh::validate(std::size_t jointCount) const {
    const std::size_t count = positions.size();
    if (normals.size() != count || occlusion.size() != count || joints.size() != count ||
        weights.size() != count) {
        return tl::make_unexpected("the vertex arrays differ in size");
    }
    if (count == 0 || indices.empty() || indices.size() % 3 != 0) {
        return tl::make_unexpected("the mesh has no whole triangles");
    }
    if (std::any_of(indices.begin(), indices.end(), [&](std::uint32_t index) { return index >= count; })) {
        return tl::make_unexpected("a triangle names a vertex that does not exist");
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!isFinite(positions[i]) || !isFinite(normals[i]) || !std::isfinite(occlusion[i])) {
            return tl::make_unexpected("vertex " + std::to_string(i) + " is not finite");
        }
        if (!areWeightsSound(weights[i])) {
            return tl::make_unexpected("the weights of vertex " + std::to_string(i) + " do not sum to 1");
        }
        if (std::any_of(joints[i].begin(), joints[i].end(),
                        [&](auto joint) { return joint >= jointCount; })) {
            return tl::make_unexpected("vertex " + std::to_string(i) + " names a joint that does not exist");
        }
    }
    return {};
}

void computeNormals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
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
