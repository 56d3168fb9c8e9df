// SPDX-License-Identifier: MIT
#include "render/passes/surroundings.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <algorithm>

#include <epoxy/gl.h>

namespace posewire::render {

tl::expected<SurroundingsPass, std::string> SurroundingsPass::create() {
    auto background = createProgram({"background", shaders::screenVert(), shaders::backgroundFrag()});
    auto floor = createProgram(
        {.name = "floor", .vertex = shaders::floorVert(), .fragment = shaders::floorFrag(), .isFloor = true});
    auto bare = createProgram({.name = "bare floor",
                               .vertex = shaders::floorVert(),
                               .fragment = shaders::floorFrag(),
                               .isFloor = true,
                               .defines = "#define BARE_FLOOR\n"});
    for (const auto* program : {&background, &floor, &bare}) {
        if (!*program) {
            return tl::unexpected(program->error());
        }
    }
    auto plain = PlainFloor::create();
    if (!plain) {
        return tl::unexpected(plain.error());
    }
    SurroundingsPass pass;
    pass.m_background = std::move(*background);
    pass.m_floor = std::move(*floor);
    pass.m_bareFloor = std::move(*bare);
    pass.m_plainFloor = std::move(*plain);
    pass.m_noVertices = gl::VertexArray::create();
    return pass;
}

void SurroundingsPass::drawBackground() {
    m_noVertices.bind();
    m_background.use();
    m_background.set("region", glm::vec4(-1.0F, -1.0F, 2.0F, 2.0F));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void SurroundingsPass::drawBareFloor() {
    m_bareFloor.use();
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void SurroundingsPass::drawKept(const Frame& frame, bool isPlain, unsigned target) {
    const std::size_t view = std::min(frame.viewport.view, kMostViews - 1);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    if (!frame.scene->showFloor || isPlain) {
        m_keptBackgrounds[view].show(backgroundBlock(frame.block), target, [&] { drawBackground(); });
        if (frame.scene->showFloor) {
            m_plainFloor->draw(frame);
        }
        return;
    }
    m_keptFloors[view].show(backdropBlock(frame.block), target, [&] {
        drawBackground();
        drawBareFloor();
    });
}

void SurroundingsPass::draw(const Frame& frame) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    drawBackground();
    if (frame.scene->showFloor) {
        const bool isSeenThrough = frame.block.style.w < 1.0F;
        (isSeenThrough ? glEnable : glDisable)(GL_BLEND);
        // The picture stays opaque.
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
        m_floor.use();
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        glDisable(GL_BLEND);
    }
    glDepthMask(GL_TRUE);
}

} // namespace posewire::render
