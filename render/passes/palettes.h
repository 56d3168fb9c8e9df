// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/ring.h"
#include "render/gl/texture.h"
#include "render/passes/frame.h"

#include <vector>

namespace posewire::render {

/// What moves and shapes all characters of a picture, in two buffer textures where skinning.glsl reads it:
/// the motions of their joints, new for each picture, and the stretches of their bodies, which mostly stay.
class Palettes {
public:
    /// Of the context that is current.
    Palettes() : m_motions(&Store::create), m_fits(Store::create()) {}

    /// For the characters of the frame, in their order.
    void upload(const Frame& frame);
    void bind() const;

private:
    /// A buffer seen as a texture.
    struct Store {
        gl::Buffer buffer;
        gl::Texture texture;

        static Store create();
    };

    gl::Ring<Store, kMostViews> m_motions;
    Store m_fits;
    std::vector<DualQuaternion> m_motionsOut;
    std::vector<glm::vec4> m_fitsOut;
    std::vector<glm::vec4> m_fitsIn; ///< what the buffer holds
};

} // namespace posewire::render
