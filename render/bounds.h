// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace posewire::render {

/// An axis-aligned box, empty until something is added. Metres, world frame unless said otherwise.
struct Bounds {
    glm::vec3 min{std::numeric_limits<float>::max()};
    glm::vec3 max{std::numeric_limits<float>::lowest()};

    bool operator==(const Bounds&) const = default;

    bool isEmpty() const { return min.x > max.x; }
    glm::vec3 centre() const { return 0.5F * (min + max); }
    /// Radius of the sphere around the box.
    float radius() const { return isEmpty() ? 0.0F : 0.5F * glm::length(max - min); }

    /// 0 … 7; bit n says whether it is the upper end along axis n.
    glm::vec3 corner(int index) const {
        return {(index & 1) != 0 ? max.x : min.x, (index & 2) != 0 ? max.y : min.y,
                (index & 4) != 0 ? max.z : min.z};
    }

    void add(const glm::vec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void add(const Bounds& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
};

} // namespace posewire::render
