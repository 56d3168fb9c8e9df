// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/character_file.h"

#include <cstddef>
#include <map>
#include <string>

struct aiMaterial;
struct aiScene;
struct aiTexture;

namespace posewire::render {

class OwnFolder;

/// What assimp knows of the materials of a scene, as the renderer wants it. The textures of a file are read
/// once.
class ImportedMaterials {
public:
    /// `folder` is that of the file; null if it comes from memory.
    ImportedMaterials(const aiScene& scene, OwnFolder* folder) : m_scene(scene), m_folder(folder) {}

    /// Colour and texture of a part; adds the texture where it is new.
    void dress(unsigned material, MeshPart& part, std::vector<ImportedTexture>& textures);

private:
    int textureOf(const aiMaterial& material, std::vector<ImportedTexture>& textures);
    ImportedTexture load(const std::string& written) const;
    void readBeside(ImportedTexture& texture) const;

    const aiScene& m_scene;
    OwnFolder* m_folder;
    std::map<std::string, int> m_known;
    std::size_t m_bytes = 0; ///< of all textures
};

} // namespace posewire::render
