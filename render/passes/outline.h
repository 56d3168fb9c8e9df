// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/passes/frame.h"
#include "render/passes/instances.h"

#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// A line in two colours around what is selected, so that it shows on a suit and a background of any colour.
/// Drawn after all that is solid; it hides behind what is nearer.
class OutlinePass {
public:
    static tl::expected<OutlinePass, std::string> create();

    /// `isFloorThere`: see SkinnedPass::drawSolid.
    void draw(const Frame& frame, const Instances& instances, bool isFloorThere);

private:
    void drawAround(const Instances& instances, const InstanceRun& one, int segments, float width,
                    const glm::vec3& colour);

    gl::Program m_program;
};

} // namespace posewire::render
