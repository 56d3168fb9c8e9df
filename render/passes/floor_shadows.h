// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/passes/frame.h"

#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace posewire::render {

/// Makes of rectangles (x, y, width, height) others that cover the same and do not overlap; those without a
/// size are left out. Keeps its room for the next time.
class DisjointRectangles {
public:
    /// Good until the next call.
    std::span<const glm::vec4> of(std::span<const glm::vec4> covered);

private:
    void addSlab(float low, float high);

    std::vector<glm::vec4> m_byLeft;
    std::vector<float> m_heights;
    std::vector<glm::vec4> m_disjoint;
};

/// Puts the softened shadows of ShadowPass on a floor that is in the picture already, only where characters
/// throw any.
class FloorShadows {
public:
    static tl::expected<FloorShadows, std::string> create();

    void draw(const Frame& frame);

private:
    gl::Program m_program;
    gl::Buffer m_rectangles;
    gl::VertexArray m_array;
    std::vector<glm::vec4> m_covered;
    DisjointRectangles m_disjoint;
};

} // namespace posewire::render
