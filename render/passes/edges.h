// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/passes/frame.h"

#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// Smooths the edges of the finished picture, only where characters are: the shaders of the grid, lines and
/// points smooth their own.
class EdgePass {
public:
    static tl::expected<EdgePass, std::string> create();

    /// The framebuffer must not be multisampled.
    void draw(const Frame& frame);

private:
    /// Of a picture, in pixels from its bottom left.
    struct Region {
        int x;
        int y;
        int width;
        int height;
    };

    static Region regionOf(const Bounds& onScreen, const Viewport& viewport, float margin);

    gl::Program m_program;
    gl::VertexArray m_noVertices;
    /// A copy of the picture, as large as the viewport was.
    gl::Texture m_copy;
    std::vector<Region> m_regions;
};

} // namespace posewire::render
