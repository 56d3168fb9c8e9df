// SPDX-License-Identifier: MIT
#include "render/camera.h"

#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

constexpr float kAspect = 1.5F;

void expectNear(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-5F) {
    EXPECT_LT(glm::length(actual - expected), tolerance)
        << actual.x << ' ' << actual.y << ' ' << actual.z << " instead of " << expected.x << ' ' << expected.y
        << ' ' << expected.z;
}

Bounds person() {
    Bounds bounds;
    bounds.add(glm::vec3(1.6F, -0.9F, 0.0F));
    bounds.add(glm::vec3(2.3F, 0.9F, 1.8F));
    return bounds;
}

TEST(Camera, LooksFromPlusXAtYawZero) {
    Camera camera;
    camera.yaw = 0.0F;
    camera.pitch = 0.0F;
    camera.target = {1.0F, 2.0F, 3.0F};
    camera.distance = 4.0F;
    expectNear(camera.eye(), {5.0F, 2.0F, 3.0F});
    expectNear(camera.forward(), {-1.0F, 0.0F, 0.0F});
    expectNear(camera.right(), {0.0F, 1.0F, 0.0F});
    expectNear(camera.up(), {0.0F, 0.0F, 1.0F});
}

TEST(Camera, LooksDownAtAPositivePitch) {
    Camera camera;
    camera.pitch = 0.5F;
    EXPECT_GT(camera.eye().z, camera.target.z);
    EXPECT_LT(camera.forward().z, 0.0F);
}

TEST(Camera, ShowsTheTargetInTheMiddle) {
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        Camera camera;
        camera.projection = projection;
        const auto middle = camera.project(camera.target, kAspect);
        ASSERT_TRUE(middle.has_value());
        EXPECT_NEAR(middle->x, 0.0F, 1e-5F);
        EXPECT_NEAR(middle->y, 0.0F, 1e-5F);
    }
}

TEST(Camera, KeepsTheSizeAtTheTargetBetweenProjections) {
    Camera camera;
    const glm::vec3 point = camera.target + 0.7F * camera.up() + 0.4F * camera.right();
    const glm::vec2 perspective = camera.project(point, kAspect).value_or(glm::vec2(9.0F));
    camera.projection = Projection::Orthographic;
    const glm::vec2 orthographic = camera.project(point, kAspect).value_or(glm::vec2(-9.0F));
    EXPECT_NEAR(perspective.x, orthographic.x, 1e-4F);
    EXPECT_NEAR(perspective.y, orthographic.y, 1e-4F);
}

TEST(Camera, CastsRaysThroughWhatItShows) {
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        Camera camera;
        camera.projection = projection;
        const glm::vec3 point{0.4F, -0.6F, 1.3F};
        const auto screen = camera.project(point, kAspect);
        ASSERT_TRUE(screen.has_value());
        const Ray ray = camera.rayThrough(*screen, kAspect);
        const float along = glm::dot(point - ray.origin, ray.direction);
        EXPECT_GT(along, 0.0F);
        expectNear(ray.origin + along * ray.direction, point, 1e-3F);
    }
}

TEST(Camera, DoesNotShowWhatIsBehindTheEye) {
    const Camera camera;
    EXPECT_FALSE(camera.project(camera.eye() - camera.forward(), kAspect).has_value());
}

TEST(Camera, StopsShortOfThePoles) {
    Camera camera;
    camera.orbit(0.0F, 9.0F);
    EXPECT_LT(camera.pitch, 1.5708F);
    EXPECT_NEAR(glm::length(camera.up()), 1.0F, 1e-5F);
    camera.orbit(100.0F, -20.0F);
    EXPECT_GT(camera.pitch, -1.5708F);
    EXPECT_LE(std::abs(camera.yaw), 3.1416F);
}

TEST(Camera, PansWithThePointer) {
    Camera camera;
    const glm::vec3 grabbed = camera.target;
    camera.pan({0.25F, -0.1F});
    const glm::vec2 screen = camera.project(grabbed, kAspect).value_or(glm::vec2(9.0F));
    // A quarter of the height is half a device unit high, and 1 / aspect of that wide.
    EXPECT_NEAR(screen.x, 0.5F / kAspect, 1e-4F);
    EXPECT_NEAR(screen.y, -0.2F, 1e-4F);
}

TEST(Camera, ZoomsWithinReason) {
    Camera camera;
    camera.zoom(0.5F);
    EXPECT_FLOAT_EQ(camera.distance, 2.5F);
    camera.zoom(1e-9F);
    EXPECT_GT(camera.distance, 0.1F);
    camera.zoom(1e9F);
    EXPECT_LE(camera.distance, 200.0F);
    camera.zoom(-1.0F);
    EXPECT_GT(camera.distance, 0.1F);
}

TEST(Camera, FramesTheWholeBoxAndLittleMore) {
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        for (const float aspect : {0.4F, 1.0F, 2.5F}) {
            Camera camera;
            camera.projection = projection;
            camera.frame(person(), aspect);
            float outermost = 0.0F;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec2 screen =
                    camera.project(person().corner(corner), aspect).value_or(glm::vec2(9.0F));
                outermost = std::max({outermost, std::abs(screen.x), std::abs(screen.y)});
            }
            EXPECT_LT(outermost, 1.0F);
            EXPECT_GT(outermost, 0.9F);
        }
    }
}

TEST(Camera, DoesNotFrameWhatHasNoSize) {
    const Camera before;
    Camera camera;
    camera.frame(Bounds(), kAspect);
    Bounds broken = person();
    broken.max.y = std::numeric_limits<float>::infinity();
    camera.frame(broken, kAspect);
    EXPECT_EQ(camera.distance, before.distance);
    EXPECT_EQ(camera.target, before.target);
}

TEST(Camera, HasStandardViews) {
    const Camera camera;
    expectNear(facing(camera, StandardView::Front).forward(), {-1.0F, 0.0F, 0.0F});
    expectNear(facing(camera, StandardView::Left).forward(), {0.0F, -1.0F, 0.0F});
    expectNear(facing(camera, StandardView::Right).forward(), {0.0F, 1.0F, 0.0F});
    expectNear(facing(camera, StandardView::Back).forward(), {1.0F, 0.0F, 0.0F});
    // From above x points up, as on a map.
    expectNear(facing(camera, StandardView::Top).forward(), {0.0F, 0.0F, -1.0F}, 0.05F);
    expectNear(facing(camera, StandardView::Top).up(), {1.0F, 0.0F, 0.0F}, 0.05F);
}

TEST(Camera, TurnsToAThreeQuarterViewFromAbove) {
    const Camera camera = facing(facing(Camera(), StandardView::Top), StandardView::ThreeQuarter);
    EXPECT_LT(camera.forward().x, -0.8F);
    EXPECT_LT(camera.forward().y, -0.3F);
    EXPECT_LT(camera.forward().z, -0.1F);
}

TEST(Camera, KeepsTargetAndDistanceInStandardViews) {
    Camera camera;
    camera.target = {3.0F, -2.0F, 1.0F};
    camera.distance = 7.0F;
    camera.projection = Projection::Orthographic;
    for (const StandardView view : {StandardView::Front, StandardView::Top, StandardView::ThreeQuarter}) {
        const Camera turned = facing(camera, view);
        EXPECT_EQ(turned.target, camera.target);
        EXPECT_EQ(turned.distance, camera.distance);
        EXPECT_EQ(turned.projection, camera.projection);
    }
}

TEST(Camera, FramesASinglePointFromClose) {
    Bounds point;
    point.add(glm::vec3(1.0F, 1.0F, 1.0F));
    Camera camera;
    camera.frame(point, kAspect);
    expectNear(camera.target, {1.0F, 1.0F, 1.0F});
    EXPECT_LT(camera.distance, 0.21F);
    Bounds huge;
    huge.add(glm::vec3(-1e6F));
    huge.add(glm::vec3(1e6F));
    camera.frame(huge, kAspect);
    EXPECT_LE(camera.distance, 200.0F);
}

} // namespace
} // namespace posewire::render
