// SPDX-License-Identifier: MIT
#include "render/mesh/import.h"

#include "render/mesh/flat_character.h"
#include "render/mesh/import_materials.h"
#include "render/mesh/own_folder.h"
#include "render/mesh/texture_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

#include <assimp/BaseImporter.h>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace posewire::render {
namespace {

constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GenSmoothNormals |
                            aiProcess_JoinIdenticalVertices | aiProcess_GlobalScale |
                            aiProcess_ValidateDataStructure;

/// assimp hands scenes over with Y up.
const glm::mat4 kZUpFromYUp(glm::vec4(1.0F, 0.0F, 0.0F, 0.0F), glm::vec4(0.0F, 0.0F, 1.0F, 0.0F),
                            glm::vec4(0.0F, -1.0F, 0.0F, 0.0F), glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));

/// assimp stores matrices by rows.
glm::mat4 matrixOf(const aiMatrix4x4& m) {
    return {{m.a1, m.b1, m.c1, m.d1},
            {m.a2, m.b2, m.c2, m.d2},
            {m.a3, m.b3, m.c3, m.d3},
            {m.a4, m.b4, m.c4, m.d4}};
}

glm::vec3 vectorOf(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

/// The rotation of a matrix with its scale taken out.
glm::quat rotationOf(const glm::mat4& m) {
    glm::mat3 axes(m);
    for (int i = 0; i < 3; ++i) {
        const float length = glm::length(axes[i]);
        if (!(length > 0.0F)) {
            return {1.0F, 0.0F, 0.0F, 0.0F};
        }
        axes[i] /= length;
    }
    return glm::normalize(glm::quat_cast(axes));
}

/// Triangles made of other polygons are marked as such beside their kind.
bool isOfTriangles(const aiMesh& mesh) {
    return (mesh.mPrimitiveTypes & ~static_cast<unsigned>(aiPrimitiveType_NGONEncodingFlag)) ==
           aiPrimitiveType_TRIANGLE;
}

struct Influence {
    std::uint8_t bone;
    float weight;
};

class Conversion {
public:
    Conversion(const aiScene& scene, OwnFolder* folder) : m_scene(scene), m_materials(scene, folder) {}

    tl::expected<ImportedCharacter, std::string> run() {
        std::size_t vertices = 0;
        for (unsigned i = 0; i < m_scene.mNumMeshes; ++i) {
            vertices += m_scene.mMeshes[i]->mNumBones > 0 ? m_scene.mMeshes[i]->mNumVertices : 0;
            for (unsigned b = 0; b < m_scene.mMeshes[i]->mNumBones; ++b) {
                m_boneIndex.emplace(m_scene.mMeshes[i]->mBones[b]->mName.C_Str(), -1);
            }
        }
        if (m_boneIndex.empty()) {
            return tl::make_unexpected("the file has no mesh with bones");
        }
        if (vertices > kMostImportedVertices) {
            return tl::make_unexpected("the file has more than 500,000 vertices");
        }
        if (!hasNodes()) {
            return tl::make_unexpected("a bone of the file has no node");
        }
        addJoiningNodes(*m_scene.mRootNode);
        if (m_boneIndex.size() > kMostImportedBones) {
            return tl::make_unexpected("the file has more than 256 bones");
        }
        addBones(*m_scene.mRootNode, kZUpFromYUp, -1);
        for (unsigned i = 0; i < m_scene.mNumMeshes; ++i) {
            addMesh(*m_scene.mMeshes[i]);
        }
        if (!m_hasTexturePlaces) {
            m_character.texturePlaces.clear();
        }
        readPictures(m_character.textures);
        if (const auto sound = validate(m_character); !sound) {
            return tl::make_unexpected(sound.error());
        }
        return std::move(m_character);
    }

private:
    bool hasNodes() const {
        return std::ranges::all_of(m_boneIndex, [this](const auto& bone) {
            return m_scene.mRootNode->FindNode(bone.first.c_str()) != nullptr;
        });
    }

    /// Nodes between bones are bones without vertices: exporters leave those out. Returns whether there is a
    /// bone in the branch.
    bool addJoiningNodes(const aiNode& node) {
        unsigned branches = 0;
        for (unsigned i = 0; i < node.mNumChildren; ++i) {
            branches += addJoiningNodes(*node.mChildren[i]) ? 1U : 0U;
        }
        const bool isBone = m_boneIndex.contains(node.mName.C_Str());
        if (!isBone && branches > 1) {
            m_boneIndex.emplace(node.mName.C_Str(), -1);
        }
        return isBone || branches > 0;
    }

    void addBones(const aiNode& node, const glm::mat4& worldFromParent, int parentBone) {
        const glm::mat4 worldFromNode = worldFromParent * matrixOf(node.mTransformation);
        const auto entry = m_boneIndex.find(node.mName.C_Str());
        if (entry != m_boneIndex.end() && entry->second < 0) {
            entry->second = static_cast<int>(m_character.bones.size());
            m_character.bones.push_back(
                {entry->first, parentBone, glm::vec3(worldFromNode[3]), rotationOf(worldFromNode), false});
            m_worldFromBone.push_back(worldFromNode);
            parentBone = entry->second;
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) {
            addBones(*node.mChildren[i], worldFromNode, parentBone);
        }
    }

    void addMesh(const aiMesh& source) {
        if (source.mNumBones == 0 || !isOfTriangles(source) || !source.HasNormals()) {
            return;
        }
        const auto first = static_cast<std::uint32_t>(m_character.mesh.vertexCount());
        MeshPart part;
        part.firstIndex = static_cast<std::uint32_t>(m_character.mesh.indices.size());
        collectInfluences(source);
        for (unsigned v = 0; v < source.mNumVertices; ++v) {
            addVertex(source, v);
        }
        for (unsigned f = 0; f < source.mNumFaces; ++f) {
            const aiFace& face = source.mFaces[f];
            for (unsigned i = 0; face.mNumIndices == 3 && i < 3; ++i) {
                m_character.mesh.indices.push_back(first + face.mIndices[i]);
            }
        }
        part.indexCount = static_cast<std::uint32_t>(m_character.mesh.indices.size()) - part.firstIndex;
        m_materials.dress(source.mMaterialIndex, part, m_character.textures);
        m_character.parts.push_back(part);
    }

    void collectInfluences(const aiMesh& source) {
        m_influences.assign(source.mNumVertices, {});
        m_worldFromMesh.assign(m_character.bones.size(), glm::mat4(1.0F));
        for (unsigned b = 0; b < source.mNumBones; ++b) {
            const aiBone& bone = *source.mBones[b];
            const auto index = static_cast<std::size_t>(m_boneIndex.at(bone.mName.C_Str()));
            m_worldFromMesh[index] = m_worldFromBone[index] * matrixOf(bone.mOffsetMatrix);
            if (b == 0) {
                m_firstBone = static_cast<std::uint8_t>(index);
            }
            for (unsigned w = 0; w < bone.mNumWeights; ++w) {
                const aiVertexWeight& weight = bone.mWeights[w];
                if (weight.mVertexId < source.mNumVertices && weight.mWeight > 0.0F &&
                    std::isfinite(weight.mWeight)) {
                    m_influences[weight.mVertexId].push_back(
                        {static_cast<std::uint8_t>(index), weight.mWeight});
                }
            }
        }
    }

    /// The four largest, with sum 1: files need not keep either.
    void addWeights(std::vector<Influence>& influences) {
        if (influences.empty()) {
            influences.push_back({m_firstBone, 1.0F});
        }
        std::stable_sort(influences.begin(), influences.end(),
                         [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
        influences.resize(std::min<std::size_t>(influences.size(), 4));
        float sum = 0.0F;
        for (const Influence& influence : influences) {
            sum += influence.weight;
        }
        m_character.bones[influences[0].bone].hasWeights = true;
        JointIndices joints{};
        glm::vec4 weights(0.0F);
        for (std::size_t i = 0; i < influences.size(); ++i) {
            joints[i] = influences[i].bone;
            weights[static_cast<int>(i)] = influences[i].weight / sum;
        }
        m_character.mesh.joints.push_back(joints);
        m_character.mesh.weights.push_back(weights);
    }

    /// Skinned by the rest pose: that is the one meaning of a vertex that all formats agree on.
    void addVertex(const aiMesh& source, unsigned v) {
        SkinnedMesh& mesh = m_character.mesh;
        addWeights(m_influences[v]);
        glm::mat4 worldFromMesh(0.0F);
        for (std::size_t i = 0; i < 4; ++i) {
            worldFromMesh +=
                mesh.weights.back()[static_cast<int>(i)] * m_worldFromMesh[mesh.joints.back()[i]];
        }
        mesh.positions.emplace_back(worldFromMesh * glm::vec4(vectorOf(source.mVertices[v]), 1.0F));
        const glm::vec3 normal =
            glm::transpose(glm::inverse(glm::mat3(worldFromMesh))) * vectorOf(source.mNormals[v]);
        const float length = glm::length(normal);
        const bool hasLength = std::isfinite(length) && length > 0.0F;
        mesh.normals.push_back(hasLength ? normal / length : glm::vec3(0.0F, 0.0F, 1.0F));
        mesh.occlusion.push_back(1.0F);
        if (source.HasVertexColors(0)) {
            const aiColor4D& colour = source.mColors[0][v];
            const float bright = std::max({colour.r, colour.g, colour.b});
            mesh.occlusion.back() = std::isfinite(bright) ? std::clamp(bright, 0.0F, 1.0F) : 1.0F;
        }
        glm::vec2 place(0.0F);
        if (source.HasTextureCoords(0)) {
            const aiVector3D& uv = source.mTextureCoords[0][v];
            m_hasTexturePlaces = true;
            place = std::isfinite(uv.x) && std::isfinite(uv.y) ? glm::vec2(uv.x, 1.0F - uv.y) : place;
        }
        m_character.texturePlaces.push_back(place);
    }

    const aiScene& m_scene;
    ImportedMaterials m_materials;
    bool m_hasTexturePlaces = false;
    ImportedCharacter m_character;
    std::map<std::string, int> m_boneIndex;
    std::vector<glm::mat4> m_worldFromBone;
    // Of the mesh being added:
    std::vector<std::vector<Influence>> m_influences;
    std::vector<glm::mat4> m_worldFromMesh;
    std::uint8_t m_firstBone = 0;
};

class OpenedStream final : public Assimp::IOStream {
public:
    explicit OpenedStream(OpenedFile file) : m_file(std::move(file)) {}

    std::size_t Read(void* to, std::size_t size, std::size_t count) override {
        return std::fread(to, size, count, m_file.stream.get());
    }
    std::size_t Write(const void* /*from*/, std::size_t /*size*/, std::size_t /*count*/) override {
        return 0;
    }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const int from = origin == aiOrigin_SET ? SEEK_SET : origin == aiOrigin_CUR ? SEEK_CUR : SEEK_END;
        return std::fseek(m_file.stream.get(), static_cast<long>(offset), from) == 0 ? aiReturn_SUCCESS
                                                                                     : aiReturn_FAILURE;
    }
    [[nodiscard]] std::size_t Tell() const override {
        return static_cast<std::size_t>(std::max(0L, std::ftell(m_file.stream.get())));
    }
    [[nodiscard]] std::size_t FileSize() const override { return m_file.size; }
    void Flush() override {}

private:
    OpenedFile m_file;
};

/// The only way of assimp to files.
class OwnFiles final : public Assimp::IOSystem {
public:
    explicit OwnFiles(OwnFolder& folder) : m_folder(folder) {}

    bool Exists(const char* path) const override { return m_folder.open(path).stream != nullptr; }
    [[nodiscard]] char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* path, const char* mode) override {
        if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) {
            return nullptr;
        }
        OpenedFile file = m_folder.open(path);
        return file.stream == nullptr ? nullptr : new OpenedStream(std::move(file));
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

private:
    OwnFolder& m_folder;
};

constexpr const char* kUnknownFormat =
    "the file cannot be read as a mesh: it is of no format that is known, such "
    "as glTF, FBX or Collada, or it is damaged";
constexpr const char* kTooMuchMemory = "reading it takes more than 1 GB of memory";

tl::expected<ImportedCharacter, std::string> converted(const Assimp::Importer& importer, const aiScene* scene,
                                                       OwnFolder* folder) {
    if (scene == nullptr || scene->mRootNode == nullptr) {
        const std::string reason = importer.GetErrorString();
        if (reason.find("bad_alloc") != std::string::npos) {
            return tl::make_unexpected(kTooMuchMemory);
        }
        const bool isUnknown = reason.empty() || reason.starts_with("No suitable reader");
        return tl::make_unexpected(isUnknown ? kUnknownFormat : reason);
    }
    auto character = Conversion(*scene, folder).run();
    if (character && folder != nullptr) {
        character->filesBeside = folder->filesBeside();
    }
    return character;
}

/// The reason why a file cannot be read whatever is in it; empty for none. A binary glTF says how long it is.
std::string faultOf(const OpenedFile& file) {
    if (file.size == 0) {
        return "the file is empty";
    }
    std::array<unsigned char, 12> head{};
    const bool isRead = std::fread(head.data(), head.size(), 1, file.stream.get()) == 1;
    if (isRead && std::string_view(reinterpret_cast<const char*>(head.data()), 4) == "glTF") {
        const std::uintmax_t length =
            head[8] | head[9] << 8 | head[10] << 16 | std::uintmax_t{head[11]} << 24;
        if (length > file.size) {
            return "the file is cut short: " + std::to_string(file.size) + " of its " +
                   std::to_string(length) + " bytes are there";
        }
    }
    return {};
}

/// The reason if a glTF needs a decompressor, which this reader has not; empty else. Only its JSON is looked
/// at.
std::string compressionOf(const OpenedFile& file) {
    std::rewind(file.stream.get());
    std::array<unsigned char, 20> head{};
    const bool isBinary = std::fread(head.data(), head.size(), 1, file.stream.get()) == 1 &&
                          std::string_view(reinterpret_cast<const char*>(head.data()), 4) == "glTF";
    std::uintmax_t size = file.size;
    if (isBinary) {
        size = head[12] | head[13] << 8 | head[14] << 16 | std::uintmax_t{head[15]} << 24;
    } else {
        std::rewind(file.stream.get());
    }
    std::string json(static_cast<std::size_t>(std::min<std::uintmax_t>(size, file.size)), ' ');
    json.resize(std::fread(json.data(), 1, json.size(), file.stream.get()));
    const std::size_t required = json.find("\"extensionsRequired\"");
    const std::string_view list =
        required == std::string::npos
            ? std::string_view()
            : std::string_view(json).substr(required, json.find(']', required) - required);
    constexpr std::array<std::pair<std::string_view, const char*>, 3> kCompressions{{
        {"\"KHR_draco_mesh_compression\"", "Draco"},
        {"\"EXT_meshopt_compression\"", "meshopt"},
        {"\"KHR_meshopt_compression\"", "meshopt"},
    }};
    for (const auto& [extension, name] : kCompressions) {
        if (list.find(extension) != std::string_view::npos) {
            return "its mesh is compressed (" + std::string(name) + "): save it without compression";
        }
    }
    return {};
}

bool isOffered(std::string extension) {
    for (char& letter : extension) {
        letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    constexpr std::array<std::string_view, 5> kOffered{"glb", "gltf", "vrm", "fbx", "dae"};
    return std::ranges::find(kOffered, extension) != kOffered.end();
}

/// Every importer is code for foreign bytes, so only those of the formats on offer stay.
void dropOtherImporters(Assimp::Importer& importer) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* about = importer.GetImporterInfo(i);
        const std::string extensions = about == nullptr ? "" : about->mFileExtensions;
        if (!isOffered(extensions.substr(0, extensions.find(' ')))) {
            const std::unique_ptr<Assimp::BaseImporter> dropped(importer.GetImporter(i));
            importer.UnregisterLoader(dropped.get());
        }
    }
}

void configure(Assimp::Importer& importer) {
    dropOtherImporters(importer);
    // Else every FBX joint is split into several nodes.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
}

} // namespace

tl::expected<ImportedCharacter, std::string> importCharacter(const std::string& path) try {
    OwnFolder folder(path);
    const OpenedFile file = folder.open(path);
    if (file.stream == nullptr) {
        return tl::make_unexpected(file.size > kMostImportedBytes ? "the file is larger than 256 MB"
                                                                  : "there is no file " + path);
    }
    if (std::string fault = faultOf(file); !fault.empty()) {
        return tl::make_unexpected(std::move(fault));
    }
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension.empty() || !isOffered(extension.substr(1))) {
        return tl::make_unexpected(kUnknownFormat);
    }
    if (std::string compressed = compressionOf(file); !compressed.empty()) {
        return tl::make_unexpected(std::move(compressed));
    }
    Assimp::Importer importer;
    configure(importer);
    importer.SetIOHandler(new OwnFiles(folder)); // the importer's own from here on
    return converted(importer, importer.ReadFile(path, kSteps), &folder);
} catch (const std::bad_alloc&) {
    return tl::make_unexpected(kTooMuchMemory);
}

tl::expected<ImportedCharacter, std::string> importCharacter(std::span<const std::byte> bytes,
                                                             const std::string& extension) {
    Assimp::Importer importer;
    configure(importer);
    return converted(importer,
                     importer.ReadFileFromMemory(bytes.data(), bytes.size(), kSteps, extension.c_str()),
                     nullptr);
}

std::string importerName() {
    return "Assimp " + std::to_string(aiGetVersionMajor()) + "." + std::to_string(aiGetVersionMinor());
}

} // namespace posewire::render
