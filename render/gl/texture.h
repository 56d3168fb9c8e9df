// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/buffer.h"

#include <cstdint>
#include <span>

namespace posewire::render::gl {

/// A texture of one level whose content is drawn or copied, a picture in all levels, or a buffer seen as one.
class Texture {
public:
    enum class Format {
        Bgra8,
        Rg8,
        /// Compared by a sampler2DShadow; DepthSampler reads the values themselves.
        Depth24
    };

    static Texture create2D(Format format, int width, int height);
    /// A picture of red, green, blue and alpha, the top row first, which repeats; four bytes a texel.
    static Texture ofPicture(int width, int height, std::span<const std::uint8_t> texels);
    /// RGBA32F texels: one vec4 each.
    static Texture overBuffer(const Buffer& buffer);

    Texture() = default;
    unsigned name() const { return m_handle.name(); }
    int width() const { return m_width; }
    int height() const { return m_height; }
    void bind(unsigned unit) const;
    /// Copies a rectangle of the framebuffer that is bound for reading to the same place.
    void copyFromFramebuffer(int x, int y, int width, int height);

private:
    [[nodiscard]] static Texture begin(unsigned target, int width, int height);

    Handle<deleteTexture> m_handle;
    unsigned m_target = 0;
    int m_width = 0;
    int m_height = 0;
};

/// Reads a depth texture's own values, texel by texel, instead of comparing.
class DepthSampler {
public:
    static DepthSampler create();

    /// Takes precedence over the settings of the texture on the unit until `unbind`.
    void bind(unsigned unit) const;
    static void unbind(unsigned unit);

private:
    Handle<deleteSampler> m_handle;
};

} // namespace posewire::render::gl
