// SPDX-License-Identifier: MIT
#include "render/passes/marks.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <array>
#include <cmath>
#include <cstddef>

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

/// Axes start inside the body: what is behind the skin is nearly as strong as what is before it.
constexpr float kAxesBehind = 0.85F;

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

void addAxes(const AxesInstance& axes, const Scene& scene, std::vector<Line>& lines) {
    if (!(axes.length > 0.0F) || !(axes.alpha > 0.0F) ||
        !std::isfinite(glm::dot(axes.orientation, axes.orientation))) {
        return;
    }
    const std::array<glm::vec3, 3> colours{scene.colours.axisX, scene.colours.axisY, scene.colours.axisZ};
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 unit{0.0F};
        unit[axis] = axes.length;
        lines.push_back({axes.position, scene.axesWidth, axes.position + axes.orientation * unit, kAxesBehind,
                         glm::vec4(colours[static_cast<std::size_t>(axis)], axes.alpha)});
    }
}

gl::VertexArray lineArray(const gl::Buffer& buffer) {
    gl::VertexArray array = gl::VertexArray::create();
    array.attach(buffer, sizeof(Line), {0, 4, offsetof(Line, from)}, 1);
    array.attach(buffer, sizeof(Line), {1, 4, offsetof(Line, to)}, 1);
    array.attach(buffer, sizeof(Line), {2, 4, offsetof(Line, colour)}, 1);
    return array;
}

gl::VertexArray pointArray(const gl::Buffer& buffer) {
    gl::VertexArray array = gl::VertexArray::create();
    array.attach(buffer, sizeof(Point), {0, 4, offsetof(Point, position)}, 1);
    array.attach(buffer, sizeof(Point), {1, 4, offsetof(Point, colour)}, 1);
    array.attach(buffer, sizeof(Point), {2, 1, offsetof(Point, behind)}, 1);
    return array;
}

} // namespace

tl::expected<MarksPass, std::string> MarksPass::create() {
    auto lines = createProgram({"lines", shaders::linesVert(), shaders::linesFrag()});
    auto points = createProgram({"points", shaders::pointsVert(), shaders::pointsFrag()});
    if (!lines || !points) {
        return tl::unexpected(!lines ? lines.error() : points.error());
    }
    MarksPass pass;
    pass.m_lineProgram = std::move(*lines);
    pass.m_pointProgram = std::move(*points);
    pass.m_lines = gl::Buffer::create();
    pass.m_points = gl::Buffer::create();
    pass.m_lineArray = lineArray(pass.m_lines);
    pass.m_pointArray = pointArray(pass.m_points);
    return pass;
}

void MarksPass::upload(const Scene& scene) {
    std::vector<Line> lines;
    lines.reserve(3 * scene.axes.size() + scene.lines.size());
    for (const LineInstance& line : scene.lines) {
        lines.push_back({line.from, line.width, line.to, line.behind, line.colour});
    }
    for (const AxesInstance& axes : scene.axes) {
        addAxes(axes, scene, lines);
    }
    std::vector<Point> points;
    points.reserve(scene.points.size());
    for (const PointInstance& point : scene.points) {
        points.push_back({point.position, point.diameter, point.colour, point.behind});
    }
    m_lines.upload(std::span<const Line>(lines), gl::Buffer::Usage::Stream);
    m_points.upload(std::span<const Point>(points), gl::Buffer::Usage::Stream);
    m_lineCount = static_cast<int>(lines.size());
    m_pointCount = static_cast<int>(points.size());
}

void MarksPass::drawBatch(gl::Program& program, const gl::VertexArray& array, int count) {
    if (count == 0) {
        return;
    }
    program.use();
    array.bind();
    for (const bool isBehind : {true, false}) {
        glDepthFunc(isBehind ? GL_GREATER : GL_LEQUAL);
        program.set("isBehind", isBehind ? 1.0F : 0.0F);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
    }
}

void MarksPass::draw(const Frame&) {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    drawBatch(m_lineProgram, m_lineArray, m_lineCount);
    drawBatch(m_pointProgram, m_pointArray, m_pointCount);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

} // namespace posewire::render
