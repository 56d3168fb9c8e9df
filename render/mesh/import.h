// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/character_file.h"

#include <cstddef>
#include <span>
#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// Reads a skinned mesh of glTF (.glb, .gltf, .vrm), FBX or Collada (.dae). All skinned meshes of the file
/// become one; weights are renormalised and unweighted vertices follow the first bone. Buffers and textures
/// that the file names are read from its own folder alone. Fails with a sentence that says what is wrong with
/// the file. Hostile files crash assimp, hang it and exhaust memory: only posewire-import calls this, within
/// its limits.
tl::expected<ImportedCharacter, std::string> importCharacter(const std::string& path);

/// Does the same with a file in memory, whose format is that of the extension ("glb").
tl::expected<ImportedCharacter, std::string> importCharacter(std::span<const std::byte> bytes,
                                                             const std::string& extension);

/// What reads the files, and its version: "Assimp 5.2".
[[nodiscard]] std::string importerName();

} // namespace posewire::render
