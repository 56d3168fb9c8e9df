// SPDX-License-Identifier: MIT
#include "render/passes/outline.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

constexpr int kAllSegments = (1 << kSegmentCount) - 1;
/// Logical pixels from the body's edge to the outer edge of each line.
constexpr float kCharacterWidth = 2.9F;
constexpr float kCharacterInside = 1.4F;
constexpr float kSegmentWidth = 3.9F;
constexpr float kSegmentInside = 1.8F;
/// The inner line keeps the outer one apart from a suit of the same colour.
constexpr glm::vec3 kInside{1.0F};

} // namespace

tl::expected<OutlinePass, std::string> OutlinePass::create() {
    auto program = createProgram({"outline", shaders::outlineVert(), shaders::outlineFrag(), true});
    if (!program) {
        return tl::unexpected(program.error());
    }
    OutlinePass pass;
    pass.m_program = std::move(*program);
    return pass;
}

void OutlinePass::drawAround(const Instances& instances, const InstanceRun& one, int segments, float width,
                             const glm::vec3& colour) {
    m_program.set("outlinedSegments", segments);
    m_program.set("width", width);
    m_program.set("colour", colour);
    instances.draw(one);
}

void OutlinePass::draw(const Frame& frame, const Instances& instances, bool isFloorThere) {
    (isFloorThere ? glEnable : glDisable)(GL_CLIP_DISTANCE0);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_LEQUAL);
    glDisable(GL_BLEND);
    // Of a larger hull only what faces away is seen around the body.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    m_program.use();
    const glm::vec3& outside = frame.scene->colours.selection;
    for (const DrawnCharacter& character : frame.characters) {
        const CharacterLook& look = character.instance->look;
        if (!character.isSolid()) {
            continue;
        }
        const InstanceRun one = Instances::only(frame, character, *character.drawn);
        if (look.isSelected) {
            drawAround(instances, one, kAllSegments, kCharacterWidth, outside);
            drawAround(instances, one, kAllSegments, kCharacterInside, kInside);
        }
        if (const int segment = selectedBit(look); segment != 0) {
            drawAround(instances, one, segment, kSegmentWidth, outside);
            drawAround(instances, one, segment, kSegmentInside, kInside);
        }
    }
    glCullFace(GL_BACK);
    glDepthMask(GL_TRUE);
    glDisable(GL_CLIP_DISTANCE0);
}

} // namespace posewire::render
