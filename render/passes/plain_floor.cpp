// SPDX-License-Identifier: MIT
#include "render/passes/plain_floor.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <cmath>

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

// As the shaders divide what they draw.
constexpr int kSectors = 48;
constexpr int kRings = 9;
constexpr int kPieces = 12;

} // namespace

tl::expected<PlainFloor, std::string> PlainFloor::create() {
    auto disc = createProgram({.name = "floor disc",
                               .vertex = shaders::floorDiscVert(),
                               .fragment = shaders::floorDiscFrag(),
                               .isFloor = true});
    auto lines = createProgram({.name = "grid lines",
                                .vertex = shaders::gridLineVert(),
                                .fragment = shaders::gridLineFrag(),
                                .isFloor = true});
    auto triangle = createProgram({.name = "origin",
                                   .vertex = shaders::floorTriangleVert(),
                                   .fragment = shaders::floorDiscFrag(),
                                   .isFloor = true});
    for (const auto* program : {&disc, &lines, &triangle}) {
        if (!*program) {
            return tl::unexpected(program->error());
        }
    }
    PlainFloor floor;
    floor.m_disc = std::move(*disc);
    floor.m_lines = std::move(*lines);
    floor.m_triangle = std::move(*triangle);
    floor.m_noVertices = gl::VertexArray::create();
    return floor;
}

void PlainFloor::drawLines(const Frame& frame, float spacing, float width, const glm::vec4& colour) {
    const int eachSide = static_cast<int>(std::ceil(frame.block.floorFade.w / spacing));
    m_lines.set("spacing", spacing);
    m_lines.set("lineWidth", width * frame.viewport.pixelRatio);
    m_lines.set("lineColour", colour);
    m_lines.set("linesEachSide", eachSide);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (kPieces + 1), 2 * (2 * eachSide + 1));
}

void PlainFloor::draw(const Frame& frame) {
    m_noVertices.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    m_disc.use();
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (kSectors + 1), kRings);
    m_lines.use();
    drawLines(frame, 0.25F, 1.0F, glm::vec4(glm::vec3(frame.block.gridMinor), 0.75F));
    drawLines(frame, 1.0F, 1.25F, glm::vec4(glm::vec3(frame.block.gridMajor), 0.9F));
    if (frame.scene->showOrigin) {
        m_triangle.use();
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glDisable(GL_BLEND);
}

} // namespace posewire::render
