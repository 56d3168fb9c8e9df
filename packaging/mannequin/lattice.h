// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace posewire::render::mannequin {

/// A grid over the left half of the body, smoothly contracted at hands, head and feet so that small forms get
/// small cells without a fine grid everywhere. The first layer in y is the mirror image of the second: cells
/// between them straddle the mirror plane.
class Lattice {
public:
    explicit Lattice(double step);

    std::size_t sizeX() const { return m_x.size(); }
    std::size_t sizeY() const { return m_y.size(); }
    std::size_t sizeZ() const { return m_z.size(); }

    std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
        return (i * m_y.size() + j) * m_z.size() + k;
    }

    glm::dvec3 node(std::size_t i, std::size_t j, std::size_t k) const;

private:
    std::vector<double> m_x;
    std::vector<double> m_y;
    std::vector<double> m_z;
};

} // namespace posewire::render::mannequin
