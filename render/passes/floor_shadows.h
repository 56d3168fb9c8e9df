// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/passes/frame.h"

#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace posewire::render {

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
    std::vector<glm::vec4> m_disjoint;
};

/// Rectangles (x, y, width, height) that cover the same as `covered` and do not overlap; those without a size
/// are left out. `disjoint` keeps its room.
void makeDisjoint(std::span<const glm::vec4> covered, std::vector<glm::vec4>& disjoint);

} // namespace posewire::render
