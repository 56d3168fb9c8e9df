// SPDX-License-Identifier: MIT
#include "render/passes/skinned.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <algorithm>
#include <array>

#include <epoxy/gl.h>

namespace posewire::render {

tl::expected<SkinnedPass, std::string> SkinnedPass::create(const RenderQuality& quality) {
    static constexpr std::array<const char*, 1> kRecorded{"recordedPosition"};
    auto program = createProgram({"skinned", shaders::skinnedVert(), shaders::skinnedFrag(), true, true});
    auto record = createProgram({"record", shaders::recordVert(), {}, true, false, kRecorded});
    if (!program || !record) {
        return tl::unexpected(!program ? program.error() : record.error());
    }
    SkinnedPass pass;
    pass.m_program = std::move(*program);
    pass.m_recordProgram = std::move(*record);
    pass.m_charactersAtOnce = quality.charactersAtOnce;
    return pass;
}

void SkinnedPass::drawCharacter(const DrawnCharacter& character) {
    const CharacterLook& look = character.instance->look;
    m_program.set("paletteBase", character.paletteBase);
    m_program.set("colour", look.colour);
    m_program.set("hasSuit", character.mesh->hasSuit ? 1.0F : 0.0F);
    m_program.set("dim", std::clamp(look.dim, 0.0F, 1.0F));
    m_program.set("opacity", std::clamp(look.opacity, 0.0F, 1.0F));
    m_program.set("hatched", look.isHatched ? 1.0F : 0.0F);
    m_program.set("selectedSegment", look.selectedSegment);
    character.mesh->draw();
}

void SkinnedPass::drawSolid(const Frame& frame) {
    m_program.use();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    int drawn = 0;
    for (const DrawnCharacter& character : frame.characters) {
        if (character.isGhost() || character.onScreen.isEmpty()) {
            continue;
        }
        drawCharacter(character);
        if (m_charactersAtOnce > 0 && ++drawn % m_charactersAtOnce == 0) {
            glFinish();
        }
    }
}

void SkinnedPass::drawGhosts(const Frame& frame) {
    m_program.use();
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    for (const DrawnCharacter& character : frame.characters) {
        if (!character.isGhost() || character.onScreen.isEmpty()) {
            continue;
        }
        // Depth first, so that a limb does not show through the body it is in front of.
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_LESS);
        glDisable(GL_BLEND);
        drawCharacter(character);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDepthMask(GL_FALSE);
        glDepthFunc(GL_LEQUAL);
        glEnable(GL_BLEND);
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
        drawCharacter(character);
        glDisable(GL_BLEND);
        glDepthMask(GL_TRUE);
    }
}

std::vector<glm::vec3> SkinnedPass::record(const GpuMesh& mesh) {
    std::vector<glm::vec3> positions(static_cast<std::size_t>(mesh.vertexCount));
    gl::Buffer buffer = gl::Buffer::create();
    buffer.allocate(positions.size() * sizeof(glm::vec3), gl::Buffer::Usage::Stream);
    m_recordProgram.use();
    m_recordProgram.set("paletteBase", 0);
    mesh.array.bind();
    buffer.bindTransformFeedback(0);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, mesh.vertexCount);
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    buffer.read(std::as_writable_bytes(std::span(positions)));
    return positions;
}

} // namespace posewire::render
