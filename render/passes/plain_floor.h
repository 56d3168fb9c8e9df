// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"
#include "render/passes/frame.h"

#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// The floor in a quarter of the time that its shader takes, for the pictures of a camera that moves: a disc
/// of one colour, and its lines as geometry. Nearly the same to look at.
class PlainFloor {
public:
    static tl::expected<PlainFloor, std::string> create();

    /// Over the background, before all else.
    void draw(const Frame& frame);

private:
    void drawLines(const Frame& frame, float spacing, float width, const glm::vec4& colour);

    gl::Program m_disc;
    gl::Program m_lines;
    gl::Program m_triangle;
    gl::VertexArray m_noVertices;
};

} // namespace posewire::render
