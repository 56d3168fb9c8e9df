// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/passes/backdrop.h"
#include "render/passes/plain_floor.h"

#include <array>
#include <optional>
#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// The surroundings of the characters: the background, and the floor with its grid, its shadows and the
/// triangle at the origin. Drawn after the characters, so that nothing they hide is painted; or before them,
/// from a copy that is kept.
class SurroundingsPass {
public:
    static tl::expected<SurroundingsPass, std::string> create();

    /// After the characters.
    void draw(const Frame& frame);
    /// Before them and without shadows, into the framebuffer `target`.
    void drawKept(const Frame& frame, bool isPlain, unsigned target);

private:
    void drawBackground();
    void drawBareFloor();

    gl::Program m_background;
    gl::Program m_floor;
    gl::Program m_bareFloor;
    gl::VertexArray m_noVertices;
    std::optional<PlainFloor> m_plainFloor;
    std::array<Backdrop, kMostViews> m_keptBackgrounds;
    std::array<Backdrop, kMostViews> m_keptFloors;
};

} // namespace posewire::render
