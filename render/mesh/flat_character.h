// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/character_file.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

/// A character as it passes from the program that reads foreign files to the window, and as it is cached: in
/// one piece and in the byte order of this computer. Version 2:
///
///     "PWCHAR" 0 2                  magic, the last byte is the version
///     u32 × 7                       vertices, indices, texture places (0 or one per vertex), parts,
///     textures, bones,
///                                   files beside
///     f32 × 3 per vertex            positions
///     f32 × 3 per vertex            normals
///     f32 per vertex                occlusion
///     u8 × 4 per vertex             joints
///     f32 × 4 per vertex            weights
///     f32 × 2 per texture place
///     u32 per index
///     part:     u32 first index, u32 indices, f32 × 3 colour, i32 texture, u32 flags (1 has a colour, 2
///     two-sided,
///               4 masked)
///     bone:     i32 parent, f32 × 3 position, f32 × 4 orientation (w x y z), u32 has weights, text name
///     texture:  i32 width, i32 height, u8 × 4 per texel, text name, text problem
///     file beside: text
///     text:     u32 length, at most kLongestFlatText, and UTF-8
namespace posewire::render {

inline constexpr std::size_t kLongestFlatText = 4'096;
/// No flat character is longer.
inline constexpr std::size_t kMostFlatBytes = std::size_t{256} * 1024 * 1024;

/// Why a character is not fit to be drawn: counts beyond the limits, indices out of range, parts that do not
/// cover the triangles, bones before their parents, numbers that are not finite.
[[nodiscard]] tl::expected<void, std::string> validate(const ImportedCharacter& character);

/// For a valid character; longer texts are cut.
[[nodiscard]] std::vector<std::byte> flatten(const ImportedCharacter& character);

/// Accepts any bytes; what is returned is valid, and flattening it gives the same bytes.
[[nodiscard]] tl::expected<ImportedCharacter, std::string> unflatten(std::span<const std::byte> flat);

} // namespace posewire::render
