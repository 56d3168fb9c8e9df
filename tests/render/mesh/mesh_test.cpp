// SPDX-License-Identifier: MIT
#include "render/mesh/mesh.h"

#include <limits>

#include <gtest/gtest.h>

namespace posewire::render {
namespace {

SkinnedMesh triangle() {
    SkinnedMesh mesh;
    mesh.positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    mesh.normals.assign(3, {0.0F, 0.0F, 1.0F});
    mesh.occlusion.assign(3, 1.0F);
    mesh.joints.assign(3, {0, 1, 0, 0});
    mesh.weights.assign(3, {0.75F, 0.25F, 0.0F, 0.0F});
    mesh.indices = {0, 1, 2};
    return mesh;
}

TEST(SkinnedMesh, AcceptsASoundTriangle) {
    EXPECT_TRUE(triangle().validate(2));
}

TEST(SkinnedMesh, RejectsAnEmptyMesh) {
    EXPECT_FALSE(SkinnedMesh{}.validate(2));
}

TEST(SkinnedMesh, RejectsArraysOfDifferentSize) {
    SkinnedMesh mesh = triangle();
    mesh.weights.pop_back();
    EXPECT_FALSE(mesh.validate(2));
}

TEST(SkinnedMesh, RejectsAVertexThatDoesNotExist) {
    SkinnedMesh mesh = triangle();
    mesh.indices[1] = 3;
    EXPECT_FALSE(mesh.validate(2));
}

TEST(SkinnedMesh, RejectsPartOfATriangle) {
    SkinnedMesh mesh = triangle();
    mesh.indices.push_back(0);
    EXPECT_FALSE(mesh.validate(2));
}

TEST(SkinnedMesh, RejectsAJointThatDoesNotExist) {
    EXPECT_FALSE(triangle().validate(1));
}

TEST(SkinnedMesh, RejectsWeightsThatDoNotSumToOne) {
    SkinnedMesh mesh = triangle();
    mesh.weights[2].y = 0.3F;
    EXPECT_EQ(mesh.validate(2).error(), "the weights of vertex 2 do not sum to 1");
    mesh.weights[2] = glm::vec4(std::numeric_limits<float>::quiet_NaN());
    EXPECT_FALSE(mesh.validate(2));
}

TEST(SkinnedMesh, RejectsPlacesThatAreNotFinite) {
    SkinnedMesh mesh = triangle();
    mesh.positions[1].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(mesh.validate(2).error(), "vertex 1 is not finite");
}

} // namespace
} // namespace posewire::render
