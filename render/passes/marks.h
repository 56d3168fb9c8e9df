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
    void draw();

private:
    struct Line {
        glm::vec3 from;
        float width;
        glm::vec3 to;
        float behind;
        glm::vec4 colour;
    };
    struct Point {
        glm::vec3 position;
        float diameter;
        glm::vec4 colour;
        float behind;
    };

    void addAxes(const AxesInstance& axes, const Scene& scene);
    void attach();
    void drawBatch(gl::Program& program, const gl::VertexArray& array, int count);

    gl::Program m_lineProgram;
    gl::Program m_pointProgram;
    std::vector<Line> m_lines;
    std::vector<Point> m_points;
    gl::Buffer m_lineBuffer;
    gl::Buffer m_pointBuffer;
    gl::VertexArray m_lineArray;
    gl::VertexArray m_pointArray;
};

} // namespace posewire::render
