// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/program.h"

#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// The binding point of the uniform block Frame, and the texture units that all programs agree on.
inline constexpr unsigned kFrameBinding = 0;
inline constexpr unsigned kPaletteUnit = 0;
inline constexpr unsigned kShadowMapUnit = 1;
inline constexpr unsigned kFloorShadowUnit = 2;
inline constexpr unsigned kShadowDepthUnit = 3;
inline constexpr unsigned kPictureUnit = 4;
inline constexpr unsigned kPartTextureUnit = 5;
inline constexpr unsigned kFitUnit = 6;

struct ProgramParts {
    std::string_view name;
    std::string_view vertex;
    std::string_view fragment;
    /// The vertex shader skins.
    bool skins = false;
    /// One of them draws the floor.
    bool isFloor = false;
    /// The fragment shader paints the suit.
    bool paints = false;
    std::span<const char* const> recorded = {};
    /// Preprocessor lines before all else, for variants of one text.
    std::string_view defines = {};
};

/// Joins the shared texts with the pass's own, and binds the uniform block and the samplers.
tl::expected<gl::Program, std::string> createProgram(const ProgramParts& parts);

} // namespace posewire::render
