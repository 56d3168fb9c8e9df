// SPDX-License-Identifier: MIT
#include "render/mesh/import.h"
#include "render/mesh/joints.h"
#include "render/mesh/mannequin.h"
#include "tests/support/paths.h"

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

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
        const Segment segment = jointSegment(static_cast<std::size_t>(joint));
        EXPECT_LT(glm::distance(bone.position, kReferenceNullPose[segment]), 1e-5F) << bone.name;
        const int parent = kSegmentParents[segment];
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

TEST(Import, RefusesAMeshWithoutBones) {
    const auto imported = importText("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "obj");
    ASSERT_FALSE(imported);
    EXPECT_EQ(imported.error(), "the file has no mesh with bones");
}

} // namespace
} // namespace posewire::render
