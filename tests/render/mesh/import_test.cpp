// SPDX-License-Identifier: MIT
#include "render/mesh/import.h"
#include "render/mesh/joints.h"
#include "render/mesh/mannequin.h"
#include "render/mesh/own_folder.h"
#include "tests/render/mesh/gltf_text.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_folder.h"

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>

#include <sys/stat.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

using test::GltfText;

const std::string kMannequinPath = posewire::test::sourcePath("resources/mannequin_medium.glb").string();

std::string readFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

auto importText(const std::string& text, const std::string& extension) {
    return importCharacter(std::as_bytes(std::span(text.data(), text.size())), extension);
}

TEST(Import, ReadsOurOwnMannequinWithTheSameShapeAndWeights) {
    const auto imported = importCharacter(kMannequinPath);
    ASSERT_TRUE(imported) << imported.error();
    const SkinnedMesh own = loadMannequin(Detail::Medium);
    const SkinnedMesh& mesh = imported->mesh;
    ASSERT_EQ(mesh.vertexCount(), own.vertexCount());
    ASSERT_EQ(mesh.indices, own.indices);
    for (std::size_t i = 0; i < own.vertexCount(); ++i) {
        ASSERT_LT(glm::distance(mesh.positions[i], own.positions[i]), 1e-5F);
        ASSERT_LT(glm::distance(mesh.normals[i], own.normals[i]), 1e-4F);
        ASSERT_NEAR(mesh.occlusion[i], own.occlusion[i], 1e-5F);
        std::array<float, kJointCount> weights{};
        for (std::size_t k = 0; k < 4; ++k) {
            weights[own.joints[i][k]] += own.weights[i][static_cast<int>(k)];
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const float weight = mesh.weights[i][static_cast<int>(k)];
            const std::string& bone = imported->bones[mesh.joints[i][k]].name;
            const auto joint = std::find(kJointNames.begin(), kJointNames.end(), bone) - kJointNames.begin();
            ASSERT_NEAR(weight > 0.0F ? weights[static_cast<std::size_t>(joint)] : 0.0F, weight, 1e-6F);
        }
    }
}

TEST(Import, ReadsTheHierarchyOfOurOwnMannequin) {
    const auto imported = importCharacter(kMannequinPath);
    ASSERT_TRUE(imported) << imported.error();
    ASSERT_EQ(imported->bones.size(), kJointCount);
    for (const ImportedBone& bone : imported->bones) {
        const auto joint = std::find(kJointNames.begin(), kJointNames.end(), bone.name) - kJointNames.begin();
        ASSERT_LT(joint, static_cast<long>(kJointCount)) << bone.name;
        const auto index = static_cast<std::size_t>(joint);
        EXPECT_LT(glm::distance(bone.position, jointOrigin(index)), 1e-5F) << bone.name;
        const int parent = jointParent(index);
        if (parent < 0) {
            EXPECT_EQ(bone.parent, -1);
        } else {
            ASSERT_GE(bone.parent, 0) << bone.name;
            EXPECT_EQ(imported->bones[static_cast<std::size_t>(bone.parent)].name,
                      kJointNames[static_cast<std::size_t>(parent)]);
        }
    }
}

TEST(Import, ReadsFromMemory) {
    const auto imported = importText(readFile(kMannequinPath), "glb");
    ASSERT_TRUE(imported) << imported.error();
    EXPECT_EQ(imported->bones.size(), kJointCount);
}

TEST(Import, SaysThatAFileIsMissing) {
    const auto imported = importCharacter("/nowhere/nobody.glb");
    ASSERT_FALSE(imported);
    EXPECT_NE(imported.error().find("nobody.glb"), std::string::npos) << imported.error();
}

TEST(Import, RefusesGarbageOfEveryFormatWithAMessage) {
    for (const char* extension : {"glb", "gltf", "fbx", "dae", "obj", "xyz", ""}) {
        for (const std::string& text :
             {std::string(), std::string("no mesh at all"), std::string(4096, '\xFF')}) {
            const auto imported = importText(text, extension);
            ASSERT_FALSE(imported) << extension;
            EXPECT_FALSE(imported.error().empty()) << extension;
        }
    }
}

TEST(Import, RefusesCutFilesWithAMessage) {
    const std::string whole = readFile(kMannequinPath);
    for (std::size_t size = 100; size + 100 < whole.size(); size += whole.size() / 23) {
        const auto imported = importText(whole.substr(0, size), "glb");
        ASSERT_FALSE(imported) << size;
        EXPECT_FALSE(imported.error().empty());
    }
}

TEST(Import, SaysWhatIsWrongWithAFileInPlainWords) {
    const auto folder = posewire::test::newTemporaryFolder("import");
    const auto errorOf = [&folder](const std::string& content) {
        const auto path = folder / "own.glb";
        std::ofstream(path, std::ios::binary) << content;
        const auto imported = importCharacter(path.string());
        return imported ? std::string() : imported.error();
    };
    const std::string whole = readFile(kMannequinPath);
    EXPECT_EQ(errorOf(""), "the file is empty");
    EXPECT_EQ(errorOf(whole.substr(0, 5000)),
              "the file is cut short: 5000 of its " + std::to_string(whole.size()) + " bytes are there");
    EXPECT_NE(errorOf("no mesh at all").find("no format that is known"), std::string::npos);
    EXPECT_EQ(errorOf(whole), "");
    std::filesystem::remove_all(folder);
}

TEST(Import, NamesTheCompressionThatAFileNeeds) {
    const auto folder = posewire::test::newTemporaryFolder("import");
    const std::string path = (folder / "own.gltf").string();
    for (const auto& [extension, name] : {std::pair{"KHR_draco_mesh_compression", "Draco"},
                                          std::pair{"EXT_meshopt_compression", "meshopt"}}) {
        const std::string json = GltfText().text();
        std::ofstream(path) << "{\"extensionsRequired\":[\"" << extension << "\"],"
                            << json.substr(json.find('{') + 1);
        const auto imported = importCharacter(path);
        ASSERT_FALSE(imported);
        EXPECT_EQ(imported.error(),
                  "its mesh is compressed (" + std::string(name) + "): save it without compression");
        std::string binary = readFile(kMannequinPath);
        const std::string key = "\"asset\":";
        const std::size_t at = binary.find(key);
        ASSERT_NE(at, std::string::npos);
        const std::string required = "\"extensionsRequired\":[\"" + std::string(extension) + "\"],";
        binary.insert(at, required);
        for (const std::size_t count : {8, 12}) { // of the file, of its JSON
            std::uint32_t size = 0;
            std::memcpy(&size, binary.data() + count, sizeof(size));
            size += static_cast<std::uint32_t>(required.size());
            std::memcpy(binary.data() + count, &size, sizeof(size));
        }
        std::ofstream(folder / "own.glb", std::ios::binary) << binary;
        const auto whole = importCharacter((folder / "own.glb").string());
        ASSERT_FALSE(whole);
        EXPECT_EQ(whole.error(), imported.error());
    }
    std::filesystem::remove_all(folder);
}

TEST(Import, RefusesAMeshWithoutBones) {
    GltfText file;
    file.boneCount = 2;
    std::string text = file.text();
    const std::size_t skin = text.find("\"skin\":0");
    ASSERT_NE(skin, std::string::npos);
    const auto imported = importText(text.replace(skin, 8, "\"skim\":0"), "gltf");
    ASSERT_FALSE(imported);
    EXPECT_EQ(imported.error(), "the file has no mesh with bones");
}

TEST(Import, ReadsNoFormatThatIsNotOffered) {
    const auto folder = posewire::test::newTemporaryFolder("import");
    for (const char* name : {"own.obj", "own.zae", "own.bvh", "own"}) {
        std::ofstream(folder / name) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        const auto imported = importCharacter((folder / name).string());
        ASSERT_FALSE(imported);
        EXPECT_NE(imported.error().find("no format that is known"), std::string::npos) << imported.error();
    }
    EXPECT_FALSE(importText("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "obj"));
    std::filesystem::remove_all(folder);
}

TEST(OwnFolder, OpensRegularFilesBelowTheFolderAlone) {
    const auto folder = posewire::test::newTemporaryFolder("own-folder");
    std::filesystem::create_directories(folder / "own/textures");
    for (const char* name : {"own/a.glb", "own/textures/b.png", "own/c.png", "secret"}) {
        std::ofstream(folder / name) << "x";
    }
    std::filesystem::create_symlink("../secret", folder / "own/out.png");
    std::filesystem::create_symlink("c.png", folder / "own/in.png");
    ASSERT_EQ(::mkfifo((folder / "own/fifo.png").c_str(), 0600), 0);
    OwnFolder own((folder / "own/a.glb").string());
    const std::string before = (folder / "own").string() + "/";
    for (const std::string& name :
         {before + "a.glb", before + "textures/b.png", std::string("textures\\b.png"),
          std::string("D:\\art\\c.png"), std::string("in.png")}) {
        EXPECT_NE(own.open(name).stream, nullptr) << name;
    }
    for (const std::string& name : {std::string("../secret"), (folder / "secret").string(),
                                    std::string("out.png"), std::string("fifo.png"), std::string("/dev/zero"),
                                    std::string("textures"), std::string(), std::string("gone.png")}) {
        EXPECT_EQ(own.open(name).stream, nullptr) << name;
    }
    EXPECT_EQ(own.filesBeside(), (std::vector<std::string>{"textures/b.png", "c.png"}));
    std::filesystem::remove_all(folder);
}

ImportedCharacter importGltf(const GltfText& file) {
    auto imported = importText(file.text(), "gltf");
    EXPECT_TRUE(imported) << imported.error();
    return imported.value_or(ImportedCharacter{});
}

TEST(Import, TurnsYUpIntoZUp) {
    const ImportedCharacter character = importGltf({});
    ASSERT_EQ(character.bones.size(), 2U);
    EXPECT_LT(glm::distance(character.bones[0].position, glm::vec3(0.0F, 0.0F, 1.0F)), 1e-6F);
    EXPECT_LT(glm::distance(character.bones[1].position, glm::vec3(0.0F, 0.0F, 2.0F)), 1e-6F);
    EXPECT_EQ(character.bones[1].parent, 0);
    ASSERT_EQ(character.mesh.vertexCount(), 3U);
    EXPECT_LT(glm::distance(character.mesh.positions[2], glm::vec3(0.0F, 0.0F, 1.0F)), 1e-6F);
}

TEST(Import, MakesWeightsSumToOneLargestFirst) {
    GltfText file;
    file.meshes[0].weights = {0.2F, 0.6F, 0.0F, 0.0F};
    const SkinnedMesh mesh = importGltf(file).mesh;
    ASSERT_EQ(mesh.vertexCount(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(glm::distance(mesh.weights[i], glm::vec4(0.75F, 0.25F, 0.0F, 0.0F)), 1e-5F);
        EXPECT_EQ(mesh.joints[i][0], 1);
    }
}

TEST(Import, LetsVerticesWithoutWeightsFollowTheFirstBone) {
    GltfText file;
    file.meshes[0].weights = {0.0F, 0.0F, 0.0F, 0.0F};
    const SkinnedMesh mesh = importGltf(file).mesh;
    ASSERT_EQ(mesh.vertexCount(), 3U);
    EXPECT_EQ(mesh.weights[0], glm::vec4(1.0F, 0.0F, 0.0F, 0.0F));
    EXPECT_EQ(mesh.joints[0][0], 0);
}

TEST(Import, MakesNormalsWhereTheFileHasNone) {
    GltfText file;
    const SkinnedMesh made = importGltf(file).mesh;
    file.meshes[0].hasNormals = true;
    const SkinnedMesh read = importGltf(file).mesh;
    ASSERT_EQ(made.vertexCount(), 3U);
    ASSERT_EQ(read.vertexCount(), 3U);
    EXPECT_LT(glm::distance(made.normals[0], glm::vec3(0.0F, -1.0F, 0.0F)), 1e-5F);
    EXPECT_LT(glm::distance(read.normals[0], made.normals[0]), 1e-5F);
}

TEST(Import, TakesTheOcclusionFromRed) {
    GltfText file;
    EXPECT_EQ(importGltf(file).mesh.occlusion, std::vector<float>(3, 1.0F));
    file.meshes[0].red = 0.25F;
    EXPECT_EQ(importGltf(file).mesh.occlusion, std::vector<float>(3, 0.25F));
    file.meshes[0].red = 7.0F;
    EXPECT_EQ(importGltf(file).mesh.occlusion, std::vector<float>(3, 1.0F));
}

TEST(Import, JoinsTheMeshesOfAFile) {
    GltfText file;
    file.meshes.resize(2);
    file.meshes[1].positions[0] = 5.0F;
    const SkinnedMesh mesh = importGltf(file).mesh;
    EXPECT_EQ(mesh.vertexCount(), 6U);
    EXPECT_EQ(mesh.triangleCount(), 2U);
    EXPECT_TRUE(mesh.validate(2));
}

TEST(Import, TakesAtMost256Bones) {
    GltfText file;
    file.boneCount = 256;
    EXPECT_EQ(importGltf(file).bones.size(), 256U);
    file.boneCount = 257;
    const auto imported = importText(file.text(), "gltf");
    ASSERT_FALSE(imported);
    EXPECT_EQ(imported.error(), "the file has more than 256 bones");
}

} // namespace
} // namespace posewire::render
