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

} // namespace posewire::render
