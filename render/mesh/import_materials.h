// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/character_file.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

struct aiMaterial;
struct aiScene;
struct aiTexture;

namespace posewire::render {

/// A texture of more bytes than this is left out.
inline constexpr std::size_t kMostTextureBytes = std::size_t{64} * 1024 * 1024;

/// A file beside a character: only within its folder, by the path as it is written or, where that leads
/// elsewhere, by its name alone. Nothing where there is none. An empty folder has none.
std::optional<std::filesystem::path> fileBeside(const std::filesystem::path& folder,
                                                const std::string& written);

/// What assimp knows of the materials of a scene, as the renderer wants it. The textures of a file are read
/// once.
class ImportedMaterials {
public:
    /// `folder` is that of the file; empty where it comes from memory.
    ImportedMaterials(const aiScene& scene, std::filesystem::path folder);

    /// Colour and texture of a part; adds the texture where it is new.
    void dress(unsigned material, MeshPart& part, std::vector<ImportedTexture>& textures);

private:
    int textureOf(const aiMaterial& material, std::vector<ImportedTexture>& textures);
    ImportedTexture load(const std::string& written) const;

    const aiScene& m_scene;
    std::filesystem::path m_folder;
    std::map<std::string, int> m_known;
};

} // namespace posewire::render
