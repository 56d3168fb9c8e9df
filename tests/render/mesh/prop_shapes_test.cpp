// SPDX-License-Identifier: MIT
#include "render/mesh/prop_shapes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

TEST(PropShapes, AreChosenByName) {
    EXPECT_EQ(propShapeOf("Sword"), PropShape::Sword);
    EXPECT_EQ(propShapeOf("KATANA 2"), PropShape::Sword);
    EXPECT_EQ(propShapeOf("Golfclub"), PropShape::GolfClub);
    EXPECT_EQ(propShapeOf("left crutch"), PropShape::Stick);
    EXPECT_EQ(propShapeOf("Generic"), PropShape::Generic);
    EXPECT_EQ(propShapeOf("Prop1"), PropShape::Generic);
    EXPECT_EQ(propShapeOf(""), PropShape::Generic);
    EXPECT_EQ(propShapeOf("\xff\xfe"), PropShape::Generic);
}

/// Cubic metres; what is inside out counts against the rest.
float enclosedBy(const SkinnedMesh& mesh) {
    float volume = 0.0F;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t corner) { return mesh.positions[mesh.indices[i + corner]]; };
        volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0F;
    }
    return volume;
}

TEST(PropShapes, EncloseWhatTheirSolidsDo) {
    EXPECT_NEAR(enclosedBy(propMesh(PropShape::Box)), 0.4F * 0.4F * 0.4F, 1e-5F);
    EXPECT_NEAR(enclosedBy(propMesh(PropShape::Stick)), 3.14F * 0.014F * 0.014F * 0.9F, 4e-5F);
    EXPECT_NEAR(enclosedBy(propMesh(PropShape::Ball)), 4.19F * 0.11F * 0.11F * 0.11F, 5e-4F);
}

TEST(PropShapes, AreSoundMeshesWhoseSidesFaceOutwards) {
    for (std::size_t shape = 0; shape < kPropShapeCount; ++shape) {
        const SkinnedMesh mesh = propMesh(static_cast<PropShape>(shape));
        ASSERT_TRUE(mesh.validate(1)) << shape;
        ASSERT_GT(mesh.triangleCount(), 10U) << shape;
        EXPECT_GT(enclosedBy(mesh), 0.0F) << shape;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t corner) { return mesh.positions[mesh.indices[i + corner]]; };
            const glm::vec3 facing = glm::cross(at(1) - at(0), at(2) - at(0));
            if (glm::length(facing) > 1e-9F) {
                EXPECT_GT(glm::dot(facing, mesh.normals[mesh.indices[i]]), 0.0F) << shape << ' ' << i / 3;
            }
        }
    }
}

TEST(PropShapes, GoAlongXFromTheHand) {
    for (const PropShape shape : {PropShape::Sword, PropShape::GolfClub, PropShape::Racket}) {
        float farthest = 0.0F;
        float aside = 0.0F;
        for (const glm::vec3& position : propMesh(shape).positions) {
            farthest = std::max(farthest, position.x);
            aside = std::max(aside, std::abs(position.y));
        }
        EXPECT_GT(farthest, 0.5F);
        EXPECT_LT(aside, 0.2F);
    }
}

} // namespace
} // namespace posewire::render
