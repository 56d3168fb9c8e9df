// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/passes/frame.h"

#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// The surroundings of the characters: the background, and the floor with its grid, its shadows and the
/// triangle at the origin. Drawn after the characters, so that nothing they hide is painted.
class SurroundingsPass {
public:
    static tl::expected<SurroundingsPass, std::string> create();

    void draw(const Frame& frame);

private:
    gl::Program m_background;
    gl::Program m_floor;
    gl::VertexArray m_noVertices;
};

} // namespace posewire::render
