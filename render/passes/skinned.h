// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/passes/frame.h"

#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// The characters: skinned, lit, in their suits.
class SkinnedPass {
public:
    static tl::expected<SkinnedPass, std::string> create(const RenderQuality& quality);

    void drawSolid(const Frame& frame);
    /// After the floor, since they let it through.
    void drawGhosts(const Frame& frame);
    /// Positions as the shaders see them, in the order of GpuMesh::vertices, by transform feedback.
    std::vector<glm::vec3> record(const GpuMesh& mesh);

private:
    void drawCharacter(const DrawnCharacter& character);

    gl::Program m_program;
    gl::Program m_recordProgram;
    int m_charactersAtOnce = 0;
};

} // namespace posewire::render
