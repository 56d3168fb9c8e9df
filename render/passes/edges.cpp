// SPDX-License-Identifier: MIT
#include "render/passes/edges.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <algorithm>
#include <cmath>

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

/// How far edges.frag looks around a pixel, in pixels.
constexpr float kReach = 6.0F;

} // namespace

tl::expected<EdgePass, std::string> EdgePass::create() {
    auto program = createProgram({"edges", shaders::screenVert(), shaders::edgesFrag()});
    if (!program) {
        return tl::unexpected(program.error());
    }
    EdgePass pass;
    pass.m_program = std::move(*program);
    pass.m_noVertices = gl::VertexArray::create();
    return pass;
}

/// The pixels of a part of the picture and of `margin` around it.
EdgePass::Region EdgePass::regionOf(const Bounds& onScreen, const Viewport& viewport, float margin) {
    const auto pixel = [](float device, int size) {
        return (0.5F * device + 0.5F) * static_cast<float>(size);
    };
    const auto first = [&](float at) { return std::max(static_cast<int>(std::floor(at - margin)), 0); };
    const auto last = [&](float at, int size) {
        return std::min(static_cast<int>(std::ceil(at + margin)), size);
    };
    const int x = first(pixel(onScreen.min.x, viewport.width));
    const int y = first(pixel(onScreen.min.y, viewport.height));
    return {x, y, last(pixel(onScreen.max.x, viewport.width), viewport.width) - x,
            last(pixel(onScreen.max.y, viewport.height), viewport.height) - y};
}

void EdgePass::draw(const Frame& frame) {
    const Viewport& viewport = frame.viewport;
    if (m_copy.width() != viewport.width || m_copy.height() != viewport.height) {
        m_copy = gl::Texture::create2D(gl::Texture::Format::Bgra8, viewport.width, viewport.height);
    }
    m_copy.bind(kPictureUnit);
    // All copies before all drawing: overlapping regions must not be smoothed twice.
    m_regions.clear();
    for (const DrawnCharacter& character : frame.characters) {
        // Stripes are smooth already and would be taken for edges.
        if (!character.onScreen.isEmpty() && !character.instance->look.isHatched) {
            const Region seen = regionOf(character.onScreen, viewport, 2.0F + kReach);
            m_copy.copyFromFramebuffer(seen.x, seen.y, seen.width, seen.height);
            m_regions.push_back(regionOf(character.onScreen, viewport, 2.0F));
        }
    }
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    m_program.use();
    m_noVertices.bind();
    const glm::vec2 scale = 2.0F / glm::vec2(viewport.width, viewport.height);
    for (const Region& region : m_regions) {
        const glm::vec2 corner = scale * glm::vec2(region.x, region.y) - 1.0F;
        m_program.set("region", glm::vec4(corner, scale * glm::vec2(region.width, region.height)));
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
}

} // namespace posewire::render
