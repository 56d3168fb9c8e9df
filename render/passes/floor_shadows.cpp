// SPDX-License-Identifier: MIT
#include "render/passes/floor_shadows.h"

#include "render/passes/shader_sources.h"
#include "shader_files.h"

#include <algorithm>

#include <epoxy/gl.h>

namespace posewire::render {

/// The parts of a line that rectangles cover between two heights at which none begins or ends.
void DisjointRectangles::addSlab(float low, float high) {
    const float middle = 0.5F * (low + high);
    bool isOpen = false;
    float left = 0.0F;
    float right = 0.0F;
    const auto close = [&] {
        if (isOpen) {
            m_disjoint.emplace_back(left, low, right - left, high - low);
        }
    };
    for (const glm::vec4& one : m_byLeft) {
        if (!(one.y < middle && one.y + one.w > middle && one.z > 0.0F)) {
            continue;
        }
        if (isOpen && one.x <= right) {
            right = std::max(right, one.x + one.z);
            continue;
        }
        close();
        isOpen = true;
        left = one.x;
        right = one.x + one.z;
    }
    close();
}

std::span<const glm::vec4> DisjointRectangles::of(std::span<const glm::vec4> covered) {
    m_disjoint.clear();
    m_byLeft.assign(covered.begin(), covered.end());
    std::ranges::sort(m_byLeft, {}, &glm::vec4::x);
    m_heights.clear();
    for (const glm::vec4& one : covered) {
        m_heights.push_back(one.y);
        m_heights.push_back(one.y + one.w);
    }
    std::ranges::sort(m_heights);
    for (std::size_t i = 1; i < m_heights.size(); ++i) {
        if (m_heights[i - 1] < m_heights[i]) {
            addSlab(m_heights[i - 1], m_heights[i]);
        }
    }
    return m_disjoint;
}

tl::expected<FloorShadows, std::string> FloorShadows::create() {
    auto program = createProgram({.name = "shaded floor",
                                  .vertex = shaders::shadedFloorVert(),
                                  .fragment = shaders::shadedFloorFrag(),
                                  .isFloor = true});
    if (!program) {
        return tl::unexpected(program.error());
    }
    FloorShadows pass;
    pass.m_program = std::move(*program);
    pass.m_rectangles = gl::Buffer::create();
    pass.m_array = gl::VertexArray::create();
    pass.m_array.attach(pass.m_rectangles, sizeof(glm::vec4), {0, 4, 0}, 1);
    return pass;
}

void FloorShadows::draw(const Frame& frame) {
    m_covered.clear();
    for (const DrawnCharacter& character : frame.characters) {
        if (character.castsShadow()) {
            const glm::vec3 low = glm::max(character.inLight.min, -1.0F);
            const glm::vec3 size = glm::min(character.inLight.max, 1.0F) - low;
            m_covered.emplace_back(low.x, low.y, size.x, size.y);
        }
    }
    const std::span<const glm::vec4> disjoint = m_disjoint.of(m_covered);
    if (disjoint.empty()) {
        return;
    }
    m_rectangles.upload(disjoint, gl::Buffer::Usage::Stream);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ZERO, GL_ONE);
    m_program.use();
    m_array.bind();
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<int>(disjoint.size()));
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

} // namespace posewire::render
