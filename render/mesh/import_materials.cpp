// SPDX-License-Identifier: MIT
#include "render/mesh/import_materials.h"

#include "render/mesh/own_folder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

namespace posewire::render {
namespace {

constexpr const char* kTooLarge = "it is larger than 64 MB";

/// What a material of linear light looks like on a display.
float displayed(float linear) {
    const float value = std::clamp(linear, 0.0F, 1.0F);
    return value <= 0.0031308F ? 12.92F * value : 1.055F * std::pow(value, 1.0F / 2.4F) - 0.055F;
}

ImportedTexture embedded(const aiTexture& source, ImportedTexture texture) {
    if (source.mHeight == 0) {
        if (source.mWidth > kMostTextureBytes) {
            texture.problem = kTooLarge;
            return texture;
        }
        const auto* bytes = reinterpret_cast<const std::byte*>(source.pcData);
        texture.encoded.assign(bytes, bytes + source.mWidth);
        return texture;
    }
    if (source.mWidth == 0 || source.mWidth > kMostTextureSide || source.mHeight > kMostTextureSide ||
        std::size_t{4} * source.mWidth * source.mHeight > kMostTextureBytes) {
        texture.problem = kTooLarge;
        return texture;
    }
    texture.width = static_cast<int>(source.mWidth);
    texture.height = static_cast<int>(source.mHeight);
    const std::size_t count = std::size_t{source.mWidth} * source.mHeight;
    texture.texels.reserve(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const aiTexel& texel = source.pcData[i];
        texture.texels.insert(texture.texels.end(), {texel.r, texel.g, texel.b, texel.a});
    }
    return texture;
}

} // namespace

void ImportedMaterials::dress(unsigned material, MeshPart& part, std::vector<ImportedTexture>& textures) {
    if (material >= m_scene.mNumMaterials) {
        return;
    }
    const aiMaterial& source = *m_scene.mMaterials[material];
    aiColor4D colour(1.0F, 1.0F, 1.0F, 1.0F);
    const bool isLinear = source.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS;
    if (isLinear || source.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS) {
        const auto shown = [isLinear](float value) {
            return !std::isfinite(value) ? 1.0F : isLinear ? displayed(value) : std::clamp(value, 0.0F, 1.0F);
        };
        part.colour = {shown(colour.r), shown(colour.g), shown(colour.b)};
        // White is what a material without a colour has.
        part.hasColour = std::min({part.colour.r, part.colour.g, part.colour.b}) < 0.99F;
    }
    int isTwoSided = 0;
    source.Get(AI_MATKEY_TWOSIDED, isTwoSided);
    part.isTwoSided = isTwoSided != 0;
    aiString mode;
    part.isMasked =
        source.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS && mode != aiString("OPAQUE");
    part.texture = textureOf(source, textures);
}

int ImportedMaterials::textureOf(const aiMaterial& material, std::vector<ImportedTexture>& textures) {
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
        aiString path;
        if (material.GetTextureCount(type) == 0 || material.GetTexture(type, 0, &path) != aiReturn_SUCCESS) {
            continue;
        }
        const auto [entry, isNew] = m_known.try_emplace(path.C_Str(), static_cast<int>(textures.size()));
        if (isNew) {
            ImportedTexture& texture = textures.emplace_back(load(entry->first));
            const std::size_t bytes = texture.encoded.size() + texture.texels.size();
            if (m_bytes + bytes > kMostTexturesBytes) {
                texture = {texture.name, {}, {}, 0, 0, "the textures are larger than 160 MB together"};
            } else {
                m_bytes += bytes;
            }
        }
        return entry->second;
    }
    return -1;
}

ImportedTexture ImportedMaterials::load(const std::string& written) const {
    ImportedTexture texture;
    texture.name = written;
    if (const aiTexture* inside = m_scene.GetEmbeddedTexture(written.c_str())) {
        return embedded(*inside, std::move(texture));
    }
    readBeside(texture);
    return texture;
}

void ImportedMaterials::readBeside(ImportedTexture& texture) const {
    const OpenedFile file = m_folder == nullptr ? OpenedFile{} : m_folder->open(texture.name);
    if (file.stream == nullptr || file.size > kMostTextureBytes) {
        texture.problem =
            file.size > kMostTextureBytes ? kTooLarge : "it is not in the folder of the character";
        return;
    }
    texture.encoded.resize(file.size);
    if (std::fread(texture.encoded.data(), 1, file.size, file.stream.get()) != file.size) {
        texture.encoded.clear();
        texture.problem = "it cannot be read";
    }
}

} // namespace posewire::render
