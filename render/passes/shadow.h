// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/framebuffer.h"
#include "render/gl/program.h"
#include "render/passes/frame.h"
#include "render/passes/instances.h"

#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// The scene's depth seen from the key light, and from it the softened shadow on the floor together with the
/// darkening where a body nearly touches it.
class ShadowPass {
public:
    static tl::expected<ShadowPass, std::string> create(const RenderQuality& quality);

    /// Takes the sizes of its pictures from the quality; where the driver refuses them, they stay.
    tl::expected<void, std::string> resize(const RenderQuality& quality);

    /// The depth first, then the shadow. Both leave another framebuffer bound.
    void drawDepth(const Instances& instances);
    void drawFloorShadow(const Frame& frame);
    /// For the passes that follow.
    void bind() const;

private:
    gl::Program m_depthProgram;
    gl::Program m_floorProgram;
    gl::Texture m_depth;
    gl::Texture m_floor;
    gl::Framebuffer m_depthTarget;
    gl::Framebuffer m_floorTarget;
    gl::DepthSampler m_depthSampler;
    gl::VertexArray m_noVertices;
};

} // namespace posewire::render
