// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/character_file.h"

#include <vector>

namespace posewire::render {

/// Limit for all textures of a character together.
inline constexpr double kMostTexels = 2048.0 * 2048.0;

/// Decodes the pictures in `encoded` (PNG, JPEG, BMP, TGA, GIF, PSD). If all textures together exceed
/// kMostTexels, scales them down by the same factor. Sets `problem` for a picture that cannot be decoded.
void readPictures(std::vector<ImportedTexture>& textures);

} // namespace posewire::render
