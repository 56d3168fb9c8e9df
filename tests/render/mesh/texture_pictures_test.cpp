// SPDX-License-Identifier: MIT
#include "render/mesh/texture_pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace posewire::render {
namespace {

/// A BMP of one red and one green texel.
std::vector<std::byte> redAndGreen() {
    constexpr std::array<unsigned char, 62> kFile{'B', 'M', 62, 0, 0, 0, 0, 0, 0,   0, 54,  0, 0,  0, 40, 0,
                                                  0,   0,   2,  0, 0, 0, 1, 0, 0,   0, 1,   0, 24, 0, 0,  0,
                                                  0,   0,   0,  0, 0, 0, 0, 0, 0,   0, 0,   0, 0,  0, 0,  0,
                                                  0,   0,   0,  0, 0, 0, 0, 0, 255, 0, 255, 0, 0,  0};
    const auto bytes = std::as_bytes(std::span(kFile));
    return {bytes.begin(), bytes.end()};
}

TEST(TexturePictures, BecomeTexelsTheTopLeftFirst) {
    std::vector<ImportedTexture> textures(1);
    textures[0].encoded = redAndGreen();
    readPictures(textures);
    EXPECT_EQ(textures[0].problem, "");
    EXPECT_EQ(textures[0].width, 2);
    EXPECT_EQ(textures[0].height, 1);
    EXPECT_EQ(textures[0].texels, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255}));
    EXPECT_TRUE(textures[0].encoded.empty());
}

TEST(TexturePictures, AreLeftOutWithAReasonIfTheyCannotBeRead) {
    std::vector<ImportedTexture> textures(2);
    textures[0].encoded.assign(100, std::byte{7});
    textures[1].encoded = redAndGreen();
    textures[1].encoded.resize(20);
    readPictures(textures);
    for (const ImportedTexture& texture : textures) {
        EXPECT_NE(texture.problem, "");
        EXPECT_EQ(texture.width, 0);
        EXPECT_TRUE(texture.texels.empty() && texture.encoded.empty());
    }
}

TEST(TexturePictures, AreMadeSmallerByOneFactorIfTheyAreTooManyTogether) {
    constexpr int kSide = 2048;
    std::vector<ImportedTexture> textures(5);
    for (ImportedTexture& texture : textures) {
        texture.width = texture.height = kSide;
        texture.texels.assign(std::size_t{4} * kSide * kSide, 200);
    }
    textures[4].width = 4;
    textures[4].height = 1;
    textures[4].texels.assign(16, 9);
    readPictures(textures);
    const auto texels = [](double sum, const ImportedTexture& one) {
        return sum + static_cast<double>(one.width) * one.height;
    };
    EXPECT_NEAR(std::accumulate(textures.begin(), textures.end(), 0.0, texels), kMostTexels, 10'000);
    EXPECT_EQ(textures[0].width, kSide / 2);
    EXPECT_EQ(textures[0].texels[12'345], 200);
    EXPECT_EQ(textures[4].width, 2);
    EXPECT_EQ(textures[4].height, 1);
}

} // namespace
} // namespace posewire::render
