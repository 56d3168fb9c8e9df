// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mesh.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>

namespace posewire::render {

/// Limits of a character: one for pictures at display rate has far less.
inline constexpr std::size_t kMostImportedBones = 256;
inline constexpr std::size_t kMostImportedVertices = 500'000;
inline constexpr std::size_t kMostImportedTriangles = 2'000'000;
inline constexpr std::size_t kMostImportedParts = 4'096; ///< also of textures, and of files beside
inline constexpr std::size_t kMostImportedBytes = std::size_t{256} * 1024 * 1024; ///< of each file
/// A larger texture is left out, and those that are larger together.
inline constexpr std::size_t kMostTextureBytes = std::size_t{64} * 1024 * 1024;
inline constexpr std::size_t kMostTexturesBytes = std::size_t{160} * 1024 * 1024;
inline constexpr int kMostTextureSide = 16'384; ///< texels

/// A bone of an imported character, in the character's rest pose.
struct ImportedBone {
    std::string name;
    /// Index of the closest ancestor that is a bone, or -1.
    int parent = -1;
    glm::vec3 position{0.0F};
    glm::quat orientation{1.0F, 0.0F, 0.0F, 0.0F};
    /// Whether a vertex follows it.
    bool hasWeights = false;
};

/// Bytes of that many texels.
[[nodiscard]] inline std::size_t texelBytes(int width, int height) {
    return std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

struct ImportedTexture {
    /// As the file calls it, for messages.
    std::string name;
    /// The bytes of a picture file, until readPictures() decodes it.
    std::vector<std::byte> encoded;
    /// Red, green, blue, alpha of each texel, the top row first.
    std::vector<std::uint8_t> texels;
    int width = 0;
    int height = 0;
    /// Why there are no texels; empty if there are.
    std::string problem;
};

/// Consecutive triangles of one material.
struct MeshPart {
    std::uint32_t firstIndex = 0;
    std::uint32_t indexCount = 0;
    /// Display values (sRGB, 0 … 1); white where the material names none.
    glm::vec3 colour{1.0F};
    /// Whether the material names a colour.
    bool hasColour = false;
    /// Index of its texture, or -1.
    int texture = -1;
    bool isTwoSided = false;
    /// Texels of little alpha are holes.
    bool isMasked = false;
};

/// A user's own character: one mesh in its rest pose, Z-up where the file says what is up, with the unit and
/// the heading that the file has.
struct ImportedCharacter {
    /// Its joints are indices into `bones`; occlusion is the brightest channel of the vertex colour, or 1
    /// where there is none.
    SkinnedMesh mesh;
    /// Of each vertex, v downwards; empty where no mesh has any.
    std::vector<glm::vec2> texturePlaces;
    /// All triangles of the mesh in their order.
    std::vector<MeshPart> parts;
    std::vector<ImportedTexture> textures;
    /// Parents come before their children; at most 256. With what joins them: nodes between bones are bones
    /// too.
    std::vector<ImportedBone> bones;
    /// Buffers and textures that were read beside the file, as paths from its folder.
    std::vector<std::string> filesBeside;
};

} // namespace posewire::render
