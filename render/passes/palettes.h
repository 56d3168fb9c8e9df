// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/texture.h"
#include "render/passes/frame.h"

namespace posewire::render {

/// The joints' motions of all characters in one buffer texture, where blendMotion of skinning.glsl reads
/// them.
class Palettes {
public:
    static Palettes create();

    void upload(const Frame& frame);
    void upload(std::span<const DualQuaternion> palette);
    void bind() const;

private:
    gl::Buffer m_buffer;
    gl::Texture m_texture;
};

} // namespace posewire::render
