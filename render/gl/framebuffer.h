// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/handle.h"
#include "render/gl/texture.h"

#include <string>

#include <tl/expected.hpp>

namespace posewire::render::gl {

/// Something to draw into. The size never changes: make another.
class Framebuffer {
public:
    /// Colour and depth; with 2 or more samples per pixel it has to be resolved before it can be read.
    static tl::expected<Framebuffer, std::string> create(int width, int height, int samples = 0);
    /// Draws into a texture that lives longer: a depth texture without colour, or a colour texture without
    /// depth.
    static tl::expected<Framebuffer, std::string> over(const Texture& texture, bool isDepth);

    Framebuffer() = default;
    unsigned name() const { return m_handle.name(); }
    int width() const { return m_width; }
    int height() const { return m_height; }
    int samples() const { return m_samples; }

    /// For drawing and reading, with the viewport set to all of it.
    void bind() const;
    /// Copies the colour, averaging samples, to another framebuffer of the same size.
    void resolveTo(unsigned framebuffer) const;
    /// Copies the colour to a place in another framebuffer, pixels from its lower left.
    void copyTo(unsigned framebuffer, int x, int y) const;

private:
    static tl::expected<Framebuffer, std::string> checked(Framebuffer framebuffer);

    Handle<deleteFramebuffer> m_handle;
    Handle<deleteRenderbuffer> m_depth;
    Handle<deleteRenderbuffer> m_multisampledColour;
    Texture m_colour;
    int m_width = 0;
    int m_height = 0;
    int m_samples = 0;
};

} // namespace posewire::render::gl
