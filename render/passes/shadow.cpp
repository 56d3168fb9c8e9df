// SPDX-License-Identifier: MIT
#include "render/passes/shadow.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

/// As many as floor_shadow.frag has room for.
constexpr std::size_t kMaxCapsules = 12;
/// Higher above the floor than this a segment darkens it too little to be seen.
constexpr float kContactHeight = 0.30F;

/// Segments that nearly touch the floor, the lowest first, as pairs: from and radius, to.
struct Contacts {
    std::array<glm::vec4, 2 * kMaxCapsules> ends{};
    std::size_t count = 0;
};

/// Of its lowest point.
float heightOf(const Capsule& capsule) {
    return std::min(capsule.from.z, capsule.to.z) - capsule.radius;
}

Contacts contacts(const DrawnCharacter& character) {
    std::array<Capsule, kSegmentCount> near;
    std::size_t count = 0;
    const SegmentCapsules capsules = stretched(character.mesh->capsules, character.instance->fit);
    for (const Capsule& own : capsules) {
        const Capsule capsule = posed(own, character.instance->palette[own.joint]);
        const float height = heightOf(capsule);
        if (capsule.radius > 0.0F && height < kContactHeight && height > -1.0F) {
            near[count++] = capsule;
        }
    }
    std::ranges::sort(std::span(near).first(count), {}, heightOf);
    Contacts packed;
    packed.count = std::min(count, kMaxCapsules);
    for (std::size_t i = 0; i < packed.count; ++i) {
        packed.ends[2 * i] = glm::vec4(near[i].from, near[i].radius);
        packed.ends[2 * i + 1] = glm::vec4(near[i].to, 0.0F);
    }
    return packed;
}

} // namespace

tl::expected<ShadowPass, std::string> ShadowPass::create(const RenderQuality& quality) {
    ShadowPass pass;
    auto depth = createProgram({"depth", shaders::depthVert(), shaders::depthFrag(), true});
    auto floor = createProgram({"floor shadow", shaders::screenVert(), shaders::floorShadowFrag()});
    if (!depth || !floor) {
        return tl::unexpected(!depth ? depth.error() : floor.error());
    }
    pass.m_depthProgram = std::move(*depth);
    pass.m_floorProgram = std::move(*floor);
    pass.m_depthSampler = gl::DepthSampler::create();
    pass.m_noVertices = gl::VertexArray::create();
    if (const auto sized = pass.resize(quality); !sized) {
        return tl::unexpected(sized.error());
    }
    return pass;
}

tl::expected<void, std::string> ShadowPass::resize(const RenderQuality& quality) {
    if (m_depth.width() == quality.shadowMapSize && m_floor.width() == quality.floorShadowSize) {
        return {};
    }
    gl::Texture depth =
        gl::Texture::create2D(gl::Texture::Format::Depth24, quality.shadowMapSize, quality.shadowMapSize);
    gl::Texture floor =
        gl::Texture::create2D(gl::Texture::Format::Rg8, quality.floorShadowSize, quality.floorShadowSize);
    auto depthTarget = gl::Framebuffer::over(depth, true);
    auto floorTarget = gl::Framebuffer::over(floor, false);
    if (!depthTarget || !floorTarget) {
        return tl::unexpected(!depthTarget ? depthTarget.error() : floorTarget.error());
    }
    m_depth = std::move(depth);
    m_floor = std::move(floor);
    m_depthTarget = std::move(*depthTarget);
    m_floorTarget = std::move(*floorTarget);
    return {};
}

void ShadowPass::bind() const {
    m_depth.bind(kShadowMapUnit);
    m_floor.bind(kFloorShadowUnit);
}

void ShadowPass::drawDepth(const Instances& instances) {
    m_depthTarget.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glClear(GL_DEPTH_BUFFER_BIT);
    m_depthProgram.use();
    for (const InstanceRun& run : instances.casters()) {
        instances.draw(run);
    }
}

void ShadowPass::drawFloorShadow(const Frame& frame) {
    if (frame.block.style.y < 0.5F) {
        return;
    }
    m_floorTarget.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    m_floorProgram.use();
    m_floorProgram.set("mapSize", static_cast<float>(m_floor.width()));
    m_depth.bind(kShadowMapUnit);
    m_depth.bind(kShadowDepthUnit);
    m_depthSampler.bind(kShadowDepthUnit);
    m_noVertices.bind();
    // Where two characters' rectangles overlap, each adds what it hides.
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glBlendEquation(GL_MAX);
    for (const DrawnCharacter& character : frame.characters) {
        if (character.castsShadow()) {
            const Contacts near = contacts(character);
            const Bounds& box = character.inLight;
            m_floorProgram.set("capsuleCount", static_cast<int>(near.count));
            m_floorProgram.set("capsules", std::span(near.ends).first(2 * near.count));
            m_floorProgram.set("region",
                               glm::vec4(box.min.x, box.min.y, box.max.x - box.min.x, box.max.y - box.min.y));
            glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        }
    }
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_BLEND);
    gl::DepthSampler::unbind(kShadowDepthUnit);
}

} // namespace posewire::render
