// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/character_file.h"

#include <vector>

namespace posewire::render {

/// Texels of all textures of a character together.
inline constexpr double kMostTexels = 2048.0 * 2048.0;

/// Makes texels of the pictures in `encoded` (PNG, JPEG, BMP, TGA, GIF, PSD), and all textures smaller by the
/// same factor if they would be too many. A picture that cannot be read leaves its problem.
void readPictures(std::vector<ImportedTexture>& textures);

} // namespace posewire::render
