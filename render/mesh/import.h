// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/character_file.h"

#include <cstddef>
#include <span>
#include <string>

#include <tl/expected.hpp>

namespace posewire::render {

/// What is read of a file at most: a character for pictures at display rate has far less.
inline constexpr std::size_t kMostImportedBones = 256;
inline constexpr std::size_t kMostImportedVertices = 500'000;
inline constexpr std::size_t kMostImportedBytes = std::size_t{256} * 1024 * 1024;

/// Reads a skinned mesh of any format that assimp knows (glTF, FBX, Collada …). All skinned meshes of the
/// file become one; weights are renormalised and unweighted vertices follow the first bone. What the file
/// names beside itself (buffers, textures) is read from its own folder alone. Fails with a sentence that says
/// what is wrong with the file.
tl::expected<ImportedCharacter, std::string> importCharacter(const std::string& path);

/// The same from memory; `extension` ("glb") names the format where the bytes alone leave it open.
tl::expected<ImportedCharacter, std::string> importCharacter(std::span<const std::byte> bytes,
                                                             const std::string& extension);

/// What reads the files, and its version: "Assimp 5.2".
[[nodiscard]] std::string importerName();

} // namespace posewire::render
