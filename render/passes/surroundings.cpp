// SPDX-License-Identifier: MIT
#include "render/passes/surroundings.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <epoxy/gl.h>

namespace posewire::render {

tl::expected<SurroundingsPass, std::string> SurroundingsPass::create() {
    auto background = createProgram({"background", shaders::screenVert(), shaders::backgroundFrag()});
    auto floor = createProgram({"floor", shaders::floorVert(), shaders::floorFrag()});
    if (!background || !floor) {
        return tl::unexpected(!background ? background.error() : floor.error());
    }
    SurroundingsPass pass;
    pass.m_background = std::move(*background);
    pass.m_floor = std::move(*floor);
    pass.m_noVertices = gl::VertexArray::create();
    return pass;
}

void SurroundingsPass::draw(const Frame& frame) {
    m_noVertices.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    m_background.use();
    m_background.set("region", glm::vec4(-1.0F, -1.0F, 2.0F, 2.0F));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
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
