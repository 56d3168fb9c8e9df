// SPDX-License-Identifier: MIT
#include "render/scene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

float brightness(const glm::vec3& colour) {
    return colour.x + colour.y + colour.z;
}

TEST(KeyLight, ComesFromAboveOverTheViewersRightShoulder) {
    Camera camera;
    for (const float yaw : {0.0F, 1.1F, -2.5F}) {
        camera.yaw = yaw;
        const glm::vec3 towards = keyLight(camera).towards;
        EXPECT_GT(glm::dot(towards, camera.right()), 0.5F);
        EXPECT_LT(glm::dot(towards, camera.forward()), -0.5F);
        EXPECT_GT(towards.z, 1.0F);
    }
}

TEST(KeyLight, StaysWhereItIsWhileTheCameraNods) {
    Camera camera;
    camera.pitch = 0.0F;
    const glm::vec3 level = keyLight(camera).towards;
    camera.pitch = 1.2F;
    EXPECT_LT(glm::distance(keyLight(camera).towards, level), 1e-5F);
}

TEST(SceneColours, KeepGridAndFloorApartOnDarkAndLight) {
    for (const SceneColours& colours : {darkSceneColours(), lightSceneColours()}) {
        EXPECT_GT(glm::distance(colours.gridMajor, colours.floor),
                  glm::distance(colours.gridMinor, colours.floor));
        EXPECT_LT(brightness(colours.shadow), brightness(colours.floor));
        EXPECT_GT(colours.axisX.x, colours.axisX.y + 0.4F);
        EXPECT_GT(colours.axisY.y, colours.axisY.x + 0.4F);
        EXPECT_GT(colours.axisZ.z, colours.axisZ.x + 0.4F);
    }
    EXPECT_LT(brightness(darkSceneColours().backgroundTop), brightness(lightSceneColours().backgroundTop));
}

TEST(Bounds, GrowAndKnowTheirSize) {
    Bounds bounds;
    EXPECT_TRUE(bounds.isEmpty());
    EXPECT_EQ(bounds.radius(), 0.0F);
    bounds.add(glm::vec3(1.0F, 2.0F, 3.0F));
    EXPECT_FALSE(bounds.isEmpty());
    EXPECT_EQ(bounds.radius(), 0.0F);
    Bounds other;
    other.add(glm::vec3(3.0F, 2.0F, 3.0F));
    bounds.add(other);
    bounds.add(Bounds());
    EXPECT_EQ(bounds.centre(), glm::vec3(2.0F, 2.0F, 3.0F));
    EXPECT_FLOAT_EQ(bounds.radius(), 1.0F);
}

} // namespace
} // namespace posewire::render
