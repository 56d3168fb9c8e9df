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

void SkinnedPass::drawRun(Shade shade, const Instances& instances, const InstanceRun& run) {
    gl::Program* const chosen = program(shade, run.hasMarks, run.own != nullptr);
    if (chosen == nullptr) {
        return;
    }
    gl::Program& program = *chosen;
    program.use();
    const Cube& cube = run.mesh->cube;
    program.set("cube", glm::vec4(cube.low, cube.side));
    program.set("hasSuit", run.mesh->hasSuit ? 1.0F : 0.0F);
    if (run.own != nullptr) {
        drawParts(program, instances, run);
    } else {
        instances.draw(run);
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

void SkinnedPass::drawParts(gl::Program& program, const Instances& instances, const InstanceRun& run) {
    constexpr float kHoleAlpha = 0.5F;
    const GpuMesh& mesh = *run.mesh;
    instances.attach(run);
    for (const MeshPart& part : mesh.parts) {
        const bool hasTexture = part.texture >= 0;
        // A material that names neither is in the character's own colour.
        const bool isPlain = !hasTexture && !part.hasColour;
        program.set("partColour", isPlain ? run.own->instance->look.colour * 0.86F + 0.10F : part.colour);
        program.set("hasTexture", hasTexture ? 1.0F : 0.0F);
        program.set("leastAlpha", part.isMasked ? kHoleAlpha : 0.0F);
        (hasTexture ? mesh.textures[static_cast<std::size_t>(part.texture)] : m_white).bind(kPartTextureUnit);
        (part.isTwoSided ? glDisable : glEnable)(GL_CULL_FACE);
        Instances::drawPart(run, part);
    }
    glEnable(GL_CULL_FACE);
}

void SkinnedPass::drawSolid(const Instances& instances, const RenderQuality& quality, bool isFloorThere) {
    const Shade shade = quality.hardSelfShadow                   ? Shade::Hard
                        : quality.shadowMapSize > kFineShadowMap ? Shade::Wide
                                                                 : Shade::Soft;
    (isFloorThere ? glEnable : glDisable)(GL_CLIP_DISTANCE0);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    int waiting = 0;
    for (const InstanceRun& run : instances.solids()) {
        if (quality.charactersAtOnce > 0 && waiting + run.count > quality.charactersAtOnce) {
            glFinish();
            waiting = 0;
        }
        drawRun(shade, instances, run);
        waiting += run.count;
    }
    glDisable(GL_CLIP_DISTANCE0);
}

void SkinnedPass::drawGhosts(const Frame& frame, const Instances& instances) {
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    for (const DrawnCharacter& character : frame.characters) {
        if (!character.isGhost() || character.onScreen.isEmpty()) {
            continue;
        }
        const InstanceRun run = Instances::only(frame, character, *character.drawn);
        // Depth first, so that a limb does not show through the body it is in front of.
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_LESS);
        glDisable(GL_BLEND);
        drawRun(Shade::Soft, instances, run);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDepthMask(GL_FALSE);
        glDepthFunc(GL_LEQUAL);
        glEnable(GL_BLEND);
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
        drawRun(Shade::Soft, instances, run);
        glDisable(GL_BLEND);
        glDepthMask(GL_TRUE);
    }
}

std::vector<glm::vec3> SkinnedPass::record(const Instances& instances, const InstanceRun& one) {
    std::vector<glm::vec3> positions(static_cast<std::size_t>(one.mesh->vertexCount));
    gl::Buffer buffer = gl::Buffer::create();
    buffer.allocate(positions.size() * sizeof(glm::vec3), gl::Buffer::Usage::Stream);
    m_recordProgram.use();
    buffer.bindTransformFeedback(0);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    instances.drawPoints(one);
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    buffer.read(std::as_writable_bytes(std::span(positions)));
    return positions;
}

} // namespace posewire::render
