// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace posewire::render::test {

/// A glTF file in one piece of text: a triangle for each entry of `meshes`, all with the same skin of
/// `boneCount` joints in a row, each 1 m above the one before (Y up).
struct GltfText {
    struct Triangle {
        std::array<float, 9> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
        std::array<std::uint8_t, 4> joints{0, 1, 0, 0};
        std::array<float, 4> weights{1, 0, 0, 0};
        /// Red of all vertices; negative leaves the colours out.
        float red = -1.0F;
        bool hasNormals = false;
    };

    std::vector<Triangle> meshes{1};
    int boneCount = 2;

    std::string text() const;
};

} // namespace posewire::render::test
