// SPDX-License-Identifier: MIT
#include "render/mesh/texture_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb/stb_image.h>
#define STB_IMAGE_RESIZE_IMPLEMENTATION
#define STB_IMAGE_RESIZE_STATIC
#include <stb/stb_image_resize.h>

namespace posewire::render {
namespace {

static_assert(STBI_MAX_DIMENSIONS == kMostTextureSide);
constexpr int kChannels = 4;

/// Sets the size to 0 if the format is unknown.
void measure(ImportedTexture& texture) {
    int channels = 0;
    if (stbi_info_from_memory(reinterpret_cast<const stbi_uc*>(texture.encoded.data()),
                              static_cast<int>(texture.encoded.size()), &texture.width, &texture.height,
                              &channels) == 0) {
        texture.width = texture.height = 0;
        texture.problem = "it is no picture of a kind that is known here";
    }
}

void decode(ImportedTexture& texture) {
    int channels = 0;
    stbi_uc* texels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(texture.encoded.data()),
                                            static_cast<int>(texture.encoded.size()), &texture.width,
                                            &texture.height, &channels, kChannels);
    texture.encoded = {};
    if (texels == nullptr) {
        texture.width = texture.height = 0;
        texture.problem = std::string("it cannot be decoded: ") + stbi_failure_reason();
        return;
    }
    texture.texels.assign(texels, texels + texelBytes(texture.width, texture.height));
    stbi_image_free(texels);
}

void shrink(ImportedTexture& texture, double scale) {
    const int width = std::max(1, static_cast<int>(std::lround(texture.width * scale)));
    const int height = std::max(1, static_cast<int>(std::lround(texture.height * scale)));
    std::vector<std::uint8_t> texels(texelBytes(width, height));
    if (stbir_resize_uint8_srgb(texture.texels.data(), texture.width, texture.height, 0, texels.data(), width,
                                height, 0, kChannels, kChannels - 1, 0) == 0) {
        texture = {texture.name, {}, {}, 0, 0, "it is too large"};
        return;
    }
    texture.texels = std::move(texels);
    texture.width = width;
    texture.height = height;
}

} // namespace

void readPictures(std::vector<ImportedTexture>& textures) {
    double texels = 0;
    for (ImportedTexture& texture : textures) {
        if (!texture.encoded.empty()) {
            measure(texture);
        }
        texels += static_cast<double>(texture.width) * texture.height;
    }
    for (ImportedTexture& texture : textures) {
        if (!texture.encoded.empty() && texture.problem.empty()) {
            decode(texture);
        }
        texture.encoded = {};
        if (texels > kMostTexels && !texture.texels.empty()) {
            shrink(texture, std::sqrt(kMostTexels / texels));
        }
    }
}

} // namespace posewire::render
