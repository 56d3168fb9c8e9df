// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/passes/frame.h"
#include "render/passes/instances.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// The characters: skinned, lit, in their suits.
class SkinnedPass {
public:
    static tl::expected<SkinnedPass, std::string> create();

    /// `isFloorThere`: the floor is in the picture already, and what is below it is left out.
    void drawSolid(const Instances& instances, const RenderQuality& quality, bool isFloorThere);
    /// After the floor, since they let it through.
    void drawGhosts(const Frame& frame, const Instances& instances);
    /// Positions of one character as the shaders see them, in the order of GpuMesh::vertices, by transform
    /// feedback.
    std::vector<glm::vec3> record(const Instances& instances, const InstanceRun& one);

private:
    /// How soft the edge of a body's shadow on itself is.
    enum class Shade : std::uint8_t { Hard, Soft, Wide };
    static constexpr std::size_t kShadeCount = 3;

    void drawRun(Shade shade, const Instances& instances, const InstanceRun& run);
    void drawParts(gl::Program& program, const Instances& instances, const InstanceRun& run);
    /// Null where the driver refuses it.
    gl::Program* program(Shade shade, bool marks, bool isOwn);

    /// The second of each pair also shows selected, solved and assumed segments, which costs time for every
    /// vertex and pixel.
    std::array<std::array<gl::Program, 2>, kShadeCount> m_programs;
    /// The same for users' own characters, made when the first is drawn.
    std::array<std::array<std::optional<gl::Program>, 2>, kShadeCount> m_ownPrograms;
    /// Bound where a part has no texture: some drivers want one.
    gl::Texture m_white;
    gl::Program m_recordProgram;
};

} // namespace posewire::render
