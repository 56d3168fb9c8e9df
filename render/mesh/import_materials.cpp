// SPDX-License-Identifier: MIT
#include "render/mesh/import_materials.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

namespace posewire::render {
namespace {

constexpr unsigned kMostTexels = 16'384;

bool isWithin(const std::filesystem::path& folder, const std::filesystem::path& file) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end() && rest != file.end();
}

/// What a material of linear light looks like on a display.
float displayed(float linear) {
    const float value = std::clamp(linear, 0.0F, 1.0F);
    return value <= 0.0031308F ? 12.92F * value : 1.055F * std::pow(value, 1.0F / 2.4F) - 0.055F;
}

ImportedTexture embedded(const aiTexture& source, ImportedTexture texture) {
    if (source.mHeight == 0) {
        if (source.mWidth > kMostTextureBytes) {
            texture.problem = "it is larger than 64 MB";
            return texture;
        }
        const auto* bytes = reinterpret_cast<const std::byte*>(source.pcData);
        texture.encoded.assign(bytes, bytes + source.mWidth);
        return texture;
    }
    if (source.mWidth == 0 || source.mWidth > kMostTexels || source.mHeight > kMostTexels ||
        std::size_t{4} * source.mWidth * source.mHeight > kMostTextureBytes) {
        texture.problem = "it is larger than 64 MB";
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

std::optional<std::filesystem::path> fileBeside(const std::filesystem::path& folder,
                                                const std::string& written) {
    if (folder.empty() || written.empty()) {
        return std::nullopt;
    }
    std::string slashed = written;
    std::ranges::replace(slashed, '\\', '/');
    std::error_code problem;
    const std::filesystem::path root = std::filesystem::canonical(folder, problem);
    const std::filesystem::path path(slashed);
    for (const std::filesystem::path& candidate : {root / path, root / path.filename()}) {
        // Links are followed first: they may lead elsewhere.
        const std::filesystem::path file = std::filesystem::weakly_canonical(candidate, problem);
        if (!problem && isWithin(root, file) && std::filesystem::is_regular_file(file, problem)) {
            return file;
        }
    }
    return std::nullopt;
}

ImportedMaterials::ImportedMaterials(const aiScene& scene, std::filesystem::path folder)
    : m_scene(scene), m_folder(std::move(folder)) {}

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
            textures.push_back(load(entry->first));
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
    const auto path = fileBeside(m_folder, written);
    if (!path) {
        texture.problem = "it is not in the folder of the character";
        return texture;
    }
    std::error_code problem;
    const std::uintmax_t size = std::filesystem::file_size(*path, problem);
    if (problem || size > kMostTextureBytes) {
        texture.problem = problem ? "it cannot be read" : "it is larger than 64 MB";
        return texture;
    }
    texture.encoded.resize(size);
    std::ifstream file(*path, std::ios::binary);
    file.read(reinterpret_cast<char*>(texture.encoded.data()), static_cast<std::streamsize>(size));
    if (!file) {
        texture.encoded.clear();
        texture.problem = "it cannot be read";
    }
    return texture;
}

} // namespace posewire::render
