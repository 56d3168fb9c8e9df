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
    pass.attach();
    return pass;
}

void MarksPass::attach() {
    m_lineBuffer = gl::Buffer::create();
    m_lineArray = gl::VertexArray::create();
    m_lineArray.attach(m_lineBuffer, sizeof(Line), {0, 4, offsetof(Line, from)}, 1);
    m_lineArray.attach(m_lineBuffer, sizeof(Line), {1, 4, offsetof(Line, to)}, 1);
    m_lineArray.attach(m_lineBuffer, sizeof(Line), {2, 4, offsetof(Line, colour)}, 1);
    m_pointBuffer = gl::Buffer::create();
    m_pointArray = gl::VertexArray::create();
    m_pointArray.attach(m_pointBuffer, sizeof(Point), {0, 4, offsetof(Point, position)}, 1);
    m_pointArray.attach(m_pointBuffer, sizeof(Point), {1, 4, offsetof(Point, colour)}, 1);
    m_pointArray.attach(m_pointBuffer, sizeof(Point), {2, 1, offsetof(Point, behind)}, 1);
}

void MarksPass::addAxes(const AxesInstance& axes, const Scene& scene) {
    if (!(axes.length > 0.0F) || !(axes.alpha > 0.0F) ||
        !std::isfinite(glm::dot(axes.orientation, axes.orientation))) {
        return;
    }
    const std::array<glm::vec3, 3> colours{scene.colours.axisX, scene.colours.axisY, scene.colours.axisZ};
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 unit{0.0F};
        unit[axis] = axes.length;
        m_lines.push_back({axes.position, scene.axesWidth, axes.position + axes.orientation * unit,
                           kAxesBehind, glm::vec4(colours[static_cast<std::size_t>(axis)], axes.alpha)});
    }
}

void MarksPass::upload(const Scene& scene) {
    m_lines.clear();
    for (const LineInstance& line : scene.lines) {
        m_lines.push_back({line.from, line.width, line.to, line.behind, line.colour});
    }
    for (const AxesInstance& axes : scene.axes) {
        addAxes(axes, scene);
    }
    m_points.clear();
    for (const PointInstance& point : scene.points) {
        m_points.push_back({point.position, point.diameter, point.colour, point.behind});
    }
    m_lineBuffer.upload(std::span<const Line>(m_lines), gl::Buffer::Usage::Stream);
    m_pointBuffer.upload(std::span<const Point>(m_points), gl::Buffer::Usage::Stream);
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

void MarksPass::draw() {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    drawBatch(m_lineProgram, m_lineArray, static_cast<int>(m_lines.size()));
    drawBatch(m_pointProgram, m_pointArray, static_cast<int>(m_points.size()));
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

} // namespace posewire::render
