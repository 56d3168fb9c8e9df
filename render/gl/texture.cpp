// SPDX-License-Identifier: MIT
#include "render/gl/texture.h"

#include <epoxy/gl.h>

namespace posewire::render::gl {
namespace {

struct Layout {
    GLint internalFormat;
    GLenum format;
    GLenum type;
};

Layout layoutOf(Texture::Format format) {
    switch (format) {
    case Texture::Format::Rg8:
        return {GL_RG8, GL_RG, GL_UNSIGNED_BYTE};
    case Texture::Format::Depth24:
        return {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};
    case Texture::Format::Bgra8:
        break;
    }
    // Named in the order that is read back: drivers that choose by it spare the conversion.
    return {GL_RGBA8, GL_BGRA, GL_UNSIGNED_BYTE};
}

} // namespace

/// A new name, bound; without texels.
Texture Texture::begin(unsigned target, int width, int height) {
    unsigned name = 0;
    glGenTextures(1, &name);
    Texture texture;
    texture.m_handle = Handle<deleteTexture>(name);
    texture.m_target = target;
    texture.m_width = width;
    texture.m_height = height;
    glBindTexture(target, name);
    return texture;
}

Texture Texture::create2D(Format format, int width, int height) {
    Texture texture = begin(GL_TEXTURE_2D, width, height);
    const Layout layout = layoutOf(format);
    glTexImage2D(GL_TEXTURE_2D, 0, layout.internalFormat, width, height, 0, layout.format, layout.type,
                 nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    if (format == Format::Depth24) {
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    return texture;
}

Texture Texture::ofPicture(int width, int height, std::span<const std::uint8_t> texels) {
    Texture texture = begin(GL_TEXTURE_2D, width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    glGenerateMipmap(GL_TEXTURE_2D);
    return texture;
}

Texture Texture::overBuffer(const Buffer& buffer) {
    Texture texture = begin(GL_TEXTURE_BUFFER, 0, 0);
    glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer.name());
    return texture;
}

void Texture::bind(unsigned unit) const {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(m_target, name());
}

void Texture::copyFromFramebuffer(int x, int y, int width, int height) {
    glBindTexture(m_target, name());
    glCopyTexSubImage2D(m_target, 0, x, y, x, y, width, height);
}

DepthSampler DepthSampler::create() {
    unsigned name = 0;
    glGenSamplers(1, &name);
    glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_NONE);
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    DepthSampler sampler;
    sampler.m_handle = Handle<deleteSampler>(name);
    return sampler;
}

void DepthSampler::bind(unsigned unit) const {
    glBindSampler(unit, m_handle.name());
}

void DepthSampler::unbind(unsigned unit) {
    glBindSampler(unit, 0);
}

} // namespace posewire::render::gl
