// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mesh.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>

namespace posewire::render {

/// A bone of an imported character, in the character's rest pose.
struct ImportedBone {
    std::string name;
    /// Index of the closest ancestor that is a bone, or -1.
    int parent = -1;
    glm::vec3 position{0.0F};
    glm::quat orientation{1.0F, 0.0F, 0.0F, 0.0F};
};

/// A user's own character: one mesh in its rest pose, metres, Z-up, with the heading that the file has.
struct ImportedCharacter {
    /// Its joints are indices into `bones`; occlusion is the red vertex colour, or 1 where there is none.
    SkinnedMesh mesh;
    /// Parents come before their children; at most 256.
    std::vector<ImportedBone> bones;
};

/// Reads a skinned mesh of any format that assimp knows (glTF, FBX, Collada …). All skinned meshes of the
/// file become one; weights are renormalised and unweighted vertices follow the first bone. Fails with a
/// sentence that says what is wrong with the file.
tl::expected<ImportedCharacter, std::string> importCharacter(const std::string& path);

/// The same from memory; `extension` ("glb") names the format where the bytes alone leave it open.
tl::expected<ImportedCharacter, std::string> importCharacter(std::span<const std::byte> bytes,
                                                             const std::string& extension);

} // namespace posewire::render
