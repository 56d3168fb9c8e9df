// SPDX-License-Identifier: MIT
#include "render/gl/framebuffer.h"

#include <epoxy/gl.h>

namespace posewire::render::gl {
namespace {

Handle<deleteFramebuffer> createFramebuffer() {
    unsigned name = 0;
    glGenFramebuffers(1, &name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    return Handle<deleteFramebuffer>(name);
}

Handle<deleteRenderbuffer> attachRenderbuffer(GLenum attachment, GLenum format,
                                              const Framebuffer& framebuffer) {
    unsigned name = 0;
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, framebuffer.samples(), format, framebuffer.width(),
                                     framebuffer.height());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
    return Handle<deleteRenderbuffer>(name);
}

} // namespace

tl::expected<Framebuffer, std::string> Framebuffer::checked(Framebuffer framebuffer) {
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        return tl::unexpected("a framebuffer of " + std::to_string(framebuffer.m_width) + " x " +
                              std::to_string(framebuffer.m_height) + " pixels and " +
                              std::to_string(framebuffer.m_samples) + " samples is refused (status " +
                              std::to_string(status) + ")");
    }
    return framebuffer;
}

tl::expected<Framebuffer, std::string> Framebuffer::create(int width, int height, int samples) {
    Framebuffer framebuffer;
    framebuffer.m_width = width;
    framebuffer.m_height = height;
    framebuffer.m_samples = samples > 1 ? samples : 0;
    framebuffer.m_handle = createFramebuffer();
    if (framebuffer.m_samples > 0) {
        framebuffer.m_multisampledColour = attachRenderbuffer(GL_COLOR_ATTACHMENT0, GL_RGBA8, framebuffer);
    } else {
        framebuffer.m_colour = Texture::create2D(Texture::Format::Bgra8, width, height);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                               framebuffer.m_colour.name(), 0);
    }
    framebuffer.m_depth = attachRenderbuffer(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, framebuffer);
    return checked(std::move(framebuffer));
}

tl::expected<Framebuffer, std::string> Framebuffer::over(const Texture& texture, bool isDepth) {
    Framebuffer framebuffer;
    framebuffer.m_width = texture.width();
    framebuffer.m_height = texture.height();
    framebuffer.m_handle = createFramebuffer();
    glFramebufferTexture2D(GL_FRAMEBUFFER, isDepth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
                           GL_TEXTURE_2D, texture.name(), 0);
    if (isDepth) {
        glDrawBuffer(GL_NONE);
        glReadBuffer(GL_NONE);
    }
    return checked(std::move(framebuffer));
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, name());
    glViewport(0, 0, m_width, m_height);
}

void Framebuffer::resolveTo(unsigned framebuffer) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, m_width, m_height, 0, 0, m_width, m_height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::copyTo(unsigned framebuffer, int x, int y) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, m_width, m_height, x, y, x + m_width, y + m_height, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
}

} // namespace posewire::render::gl
