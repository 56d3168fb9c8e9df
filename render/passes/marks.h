// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/passes/frame.h"

#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// What has a constant size on the screen: local axes, lines and round points, each with a thin outline. What
/// is behind a body shows through as far as its own `behind` says.
class MarksPass {
public:
    static tl::expected<MarksPass, std::string> create();

    void upload(const Scene& scene);
    void draw(const Frame& frame);

private:
    void drawBatch(gl::Program& program, const gl::VertexArray& array, int count);

    gl::Program m_lineProgram;
    gl::Program m_pointProgram;
    gl::Buffer m_lines;
    gl::Buffer m_points;
    gl::VertexArray m_lineArray;
    gl::VertexArray m_pointArray;
    int m_lineCount = 0;
    int m_pointCount = 0;
};

} // namespace posewire::render
