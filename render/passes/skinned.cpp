// SPDX-License-Identifier: MIT
#include "render/passes/skinned.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

/// The texels of a larger picture of the light are so small that more of them make a soft edge.
constexpr int kFineShadowMap = 1024;

/// In the order of Shade.
constexpr std::array<std::string_view, 3> kShadeDefines{"#define HARD_SELF_SHADOW\n", "",
                                                        "#define WIDE_SELF_SHADOW\n"};

tl::expected<gl::Program, std::string> paintingProgram(std::string_view shadeDefine, bool marks, bool isOwn) {
    const std::string defines = std::string(shadeDefine) + (marks ? "#define MARKS_SEGMENTS\n" : "") +
                                (isOwn ? "#define OWN_CHARACTER\n" : "");
    return createProgram({.name = isOwn ? "own character" : "skinned",
                          .vertex = shaders::skinnedVert(),
                          .fragment = shaders::skinnedFrag(),
                          .skins = true,
                          .paints = true,
                          .defines = defines});
}

/// A bit for each segment of that provenance.
int segmentsOf(const CharacterLook& look, Provenance provenance) {
    unsigned bits = 0;
    for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
        bits |= look.provenance[segment] == provenance ? 1U << segment : 0U;
    }
    return static_cast<int>(bits);
}

} // namespace

tl::expected<SkinnedPass, std::string> SkinnedPass::create() {
    static constexpr std::array<const char*, 1> kRecorded{"recordedPosition"};
    SkinnedPass pass;
    for (std::size_t shade = 0; shade < kShadeCount; ++shade) {
        for (const bool marks : {false, true}) {
            auto program = paintingProgram(kShadeDefines[shade], marks, false);
            if (!program) {
                return tl::unexpected(program.error());
            }
            pass.m_programs[shade][marks ? 1 : 0] = std::move(*program);
        }
    }
    auto record = createProgram({.name = "record",
                                 .vertex = shaders::recordVert(),
                                 .fragment = {},
                                 .skins = true,
                                 .recorded = kRecorded});
    if (!record) {
        return tl::unexpected(record.error());
    }
    pass.m_recordProgram = std::move(*record);
    constexpr std::array<std::uint8_t, 4> kWhite{255, 255, 255, 255};
    pass.m_white = gl::Texture::ofPicture(1, 1, kWhite);
    return pass;
}

void SkinnedPass::drawCharacter(Shade shade, const DrawnCharacter& character) {
    const CharacterLook& look = character.instance->look;
    const int selected = selectedBit(look);
    const int solved = segmentsOf(look, Provenance::Solved);
    const int assumed = segmentsOf(look, Provenance::Assumed);
    const bool marks = (selected | solved | assumed) != 0;
    const bool isOwn = !character.drawn->parts.empty();
    gl::Program* const chosen = program(shade, marks, isOwn);
    if (chosen == nullptr) {
        return;
    }
    gl::Program& program = *chosen;
    program.use();
    program.set("paletteBase", character.paletteBase);
    program.set("colour", look.colour);
    program.set("hasSuit", character.drawn->hasSuit ? 1.0F : 0.0F);
    program.set("dim", std::clamp(look.dim, 0.0F, 1.0F));
    program.set("opacity", std::clamp(look.opacity, 0.0F, 1.0F));
    program.set("hatched", look.isHatched ? 1.0F : 0.0F);
    if (marks) {
        program.set("selectedSegments", selected);
        program.set("solvedSegments", solved);
        program.set("assumedSegments", assumed);
    }
    if (isOwn) {
        drawParts(program, character);
    } else {
        character.drawn->draw();
    }
}

gl::Program* SkinnedPass::program(Shade shade, bool marks, bool isOwn) {
    const auto index = static_cast<std::size_t>(shade);
    if (!isOwn) {
        return &m_programs[index][marks ? 1 : 0];
    }
    std::optional<gl::Program>& own = m_ownPrograms[index][marks ? 1 : 0];
    if (!own) {
        auto made = paintingProgram(kShadeDefines[index], marks, true);
        if (!made) {
            return nullptr;
        }
        own = std::move(*made);
    }
    return &*own;
}

void SkinnedPass::drawParts(gl::Program& program, const DrawnCharacter& character) {
    constexpr float kHoleAlpha = 0.5F;
    const GpuMesh& mesh = *character.drawn;
    for (const MeshPart& part : mesh.parts) {
        const bool hasTexture = part.texture >= 0;
        // A material that names neither is in the character's own colour.
        const bool isPlain = !hasTexture && !part.hasColour;
        program.set("partColour", isPlain ? character.instance->look.colour * 0.86F + 0.10F : part.colour);
        program.set("hasTexture", hasTexture ? 1.0F : 0.0F);
        program.set("leastAlpha", part.isMasked ? kHoleAlpha : 0.0F);
        (hasTexture ? mesh.textures[static_cast<std::size_t>(part.texture)] : m_white).bind(kPartTextureUnit);
        (part.isTwoSided ? glDisable : glEnable)(GL_CULL_FACE);
        mesh.draw(part);
    }
    glEnable(GL_CULL_FACE);
}

void SkinnedPass::drawSolid(const Frame& frame, const RenderQuality& quality, bool isFloorThere) {
    const Shade shade = quality.hardSelfShadow                   ? Shade::Hard
                        : quality.shadowMapSize > kFineShadowMap ? Shade::Wide
                                                                 : Shade::Soft;
    (isFloorThere ? glEnable : glDisable)(GL_CLIP_DISTANCE0);
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
        drawCharacter(shade, character);
        if (quality.charactersAtOnce > 0 && ++drawn % quality.charactersAtOnce == 0) {
            glFinish();
        }
    }
    glDisable(GL_CLIP_DISTANCE0);
}

void SkinnedPass::drawGhosts(const Frame& frame) {
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
        drawCharacter(Shade::Soft, character);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDepthMask(GL_FALSE);
        glDepthFunc(GL_LEQUAL);
        glEnable(GL_BLEND);
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
        drawCharacter(Shade::Soft, character);
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
