// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mesh.h"

#include <string_view>

namespace posewire::render {

/// Where things lie in the binary chunk of a mannequin's .glb. The chunk begins with a MannequinFileHeader
/// that no accessor of the JSON chunk names: with it our own files are read without a JSON parser.
/// Little-endian, offsets in bytes from the start of the chunk's data.
struct MannequinFileHeader {
    std::uint32_t magic;
    std::uint32_t version;
    std::uint32_t vertexCount;
    std::uint32_t indexCount;
};

inline constexpr std::uint32_t kMannequinMagic = 0x4E4D5750; // "PWMN"
inline constexpr std::uint32_t kMannequinVersion = 2;

/// Arrays in file order: float vec3 positions and normals, float vec4 weights, byte joints, byte colours
/// (red, green and blue are the occlusion), 16-bit indices.
struct MannequinFileLayout {
    std::size_t positions;
    std::size_t normals;
    std::size_t weights;
    std::size_t joints;
    std::size_t colors;
    std::size_t indices;
    /// Of the arrays above, padded to four bytes.
    std::size_t end;

    static MannequinFileLayout of(std::size_t vertexCount, std::size_t indexCount);
};

/// Reads one of the mannequin's files in `resources`; rejects other .glb files, which importCharacter reads.
tl::expected<SkinnedMesh, std::string> readMannequinFile(std::string_view bytes);

} // namespace posewire::render
