// SPDX-License-Identifier: MIT
#include "render/passes/backdrop.h"

#include "render/passes/shader_sources.h"

#include <cstring>

#include <epoxy/gl.h>

namespace posewire::render {

bool Backdrop::isOf(const FrameBlock& block) const {
    // Byte by byte, so that what is not a number equals itself.
    return m_block && std::memcmp(&*m_block, &block, sizeof(block)) == 0;
}

bool Backdrop::renew(const FrameBlock& block) {
    const auto width = static_cast<int>(block.viewport.x);
    const auto height = static_cast<int>(block.viewport.y);
    m_block.reset();
    if (m_colour.width() != width || m_colour.height() != height) {
        glActiveTexture(GL_TEXTURE0 + kPictureUnit); // the other units are in use
        gl::Texture colour = gl::Texture::create2D(gl::Texture::Format::Bgra8, width, height);
        auto framebuffer = gl::Framebuffer::over(colour, false);
        if (!framebuffer) {
            return false;
        }
        m_colour = std::move(colour);
        m_framebuffer = std::move(*framebuffer);
    }
    m_framebuffer.bind();
    m_block = block;
    return true;
}

void Backdrop::bind(unsigned target) {
    glBindFramebuffer(GL_FRAMEBUFFER, target);
}

void Backdrop::copyTo(unsigned target) const {
    m_framebuffer.resolveTo(target);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
}

FrameBlock backgroundBlock(const FrameBlock& block) {
    FrameBlock only;
    only.viewport = block.viewport;
    only.backgroundTop = block.backgroundTop;
    only.backgroundBottom = block.backgroundBottom;
    return only;
}

FrameBlock backdropBlock(const FrameBlock& block) {
    FrameBlock only = backgroundBlock(block);
    only.viewProjection = block.viewProjection;
    only.floorFade = block.floorFade;
    only.style = block.style;
    only.floorColour = block.floorColour;
    only.gridMajor = block.gridMajor;
    only.gridMinor = block.gridMinor;
    only.originColour = block.originColour;
    return only;
}

} // namespace posewire::render
