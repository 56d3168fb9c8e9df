// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/camera_motion.h"

#include <QJsonArray>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace posewire::gui {
namespace {

constexpr float kAspect = 1.5F;
const QSizeF kView(900, 600);

render::Bounds personAt(float x, float y) {
    render::Bounds box;
    box.add(glm::vec3(x - 0.3F, y - 0.3F, 0.0F));
    box.add(glm::vec3(x + 0.3F, y + 0.3F, 1.9F));
    return box;
}

TEST(CameraMotion, FittedCameraShowsAllBoxesAndFillsThePicture) {
    const std::array boxes{personAt(0, 0), personAt(-2, 3), personAt(1, -1)};
    const render::Camera camera = fitted({}, boxes, kAspect);
    float widest = 0;
    for (const render::Bounds& box : boxes) {
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 point((corner & 1) != 0 ? box.max.x : box.min.x,
                                  (corner & 2) != 0 ? box.max.y : box.min.y,
                                  (corner & 4) != 0 ? box.max.z : box.min.z);
            const auto place = camera.project(point, kAspect);
            ASSERT_TRUE(place);
            widest = std::max({widest, std::abs(place->x), std::abs(place->y)});
        }
    }
    EXPECT_LT(widest, 1.0F);
    EXPECT_GT(widest, 0.75F);
}

TEST(CameraMotion, FittingNothingChangesNothing) {
    const render::Camera camera = fitted({}, {}, kAspect);
    EXPECT_EQ(camera.distance, render::Camera{}.distance);
}

TEST(CameraMotion, ZoomKeepsWhatIsUnderThePointer) {
    CameraMotion motion;
    const QPointF pointer(700, 150);
    const render::Ray ray = motion.camera().rayThrough(screenPoint(pointer, kView), kAspect);
    const float depth = motion.camera().distance / glm::dot(ray.direction, motion.camera().forward());
    const glm::vec3 point = ray.origin + depth * ray.direction;
    motion.zoom(4, pointer, kView);
    const auto place = motion.camera().project(point, kAspect);
    ASSERT_TRUE(place);
    EXPECT_NEAR(pointerAt(*place, kView).x(), pointer.x(), 0.5);
    EXPECT_NEAR(pointerAt(*place, kView).y(), pointer.y(), 0.5);
}

TEST(CameraMotion, FollowsUntilTheOperatorPansOrZooms) {
    CameraMotion motion;
    const std::array here{personAt(0, 0)};
    const std::array there{personAt(5, 5)};
    motion.follow(here, kAspect, 0);
    for (int i = 0; i < 100; ++i) {
        motion.follow(there, kAspect, 0.1);
    }
    EXPECT_NEAR(motion.camera().target.x, 5, 0.5);
    motion.pan({10, 0}, kView);
    const glm::vec3 target = motion.camera().target;
    motion.follow(here, kAspect, 1);
    EXPECT_EQ(motion.camera().target, target);
    motion.frame(here, kAspect);
    const glm::vec3 framed = motion.camera().target;
    motion.follow(there, kAspect, 1);
    EXPECT_NE(motion.camera().target, framed) << "framing all follows again";
}

TEST(CameraMotion, HoldsStillWhileAllStayWellInThePicture) {
    CameraMotion motion;
    motion.follow(std::array{personAt(0, 0), personAt(1, 1)}, kAspect, 0);
    const render::Camera held = motion.camera();
    for (int i = 0; i < 200; ++i) {
        const float sway = 0.06F * std::sin(0.1F * static_cast<float>(i));
        motion.follow(std::array{personAt(sway, -sway), personAt(1 + sway, 1)}, kAspect, 0.016);
        ASSERT_EQ(motion.camera(), held) << i;
    }
}

TEST(CameraMotion, GlidesAfterWhoLeavesAndComesToRest) {
    CameraMotion motion;
    motion.follow(std::array{personAt(0, 0)}, kAspect, 0);
    const std::array there{personAt(1, 2)};
    motion.follow(there, kAspect, 0.016);
    EXPECT_LT(glm::distance(motion.camera().target, glm::vec3(0, 0, 0.95F)), 0.2F) << "it does not jump";
    for (int i = 0; i < 400; ++i) {
        motion.follow(there, kAspect, 0.016);
    }
    const render::Camera rested = motion.camera();
    EXPECT_NEAR(rested.target.x, 1, 0.15);
    EXPECT_NEAR(rested.target.y, 2, 0.15);
    motion.follow(there, kAspect, 0.016);
    EXPECT_EQ(motion.camera(), rested);
}

TEST(CameraMotion, ComesCloserWhenAllHaveGathered) {
    CameraMotion motion;
    motion.follow(std::array{personAt(-4, -4), personAt(4, 4)}, kAspect, 0);
    const float distance = motion.camera().distance;
    const std::array together{personAt(0, 0), personAt(0.8F, 0)};
    for (int i = 0; i < 400; ++i) {
        motion.follow(together, kAspect, 0.016);
    }
    EXPECT_LT(motion.camera().distance, 0.6F * distance);
}

TEST(CameraMotion, IsBackAtOnceFromFarAway) {
    CameraMotion motion;
    const std::array person{personAt(0, 0)};
    motion.follow(person, kAspect, 0);
    const render::Camera before = motion.camera();
    render::Bounds astray = personAt(0, 0);
    astray.add(glm::vec3(90'000, 0, 1)); // for one sample
    motion.follow(std::array{astray}, kAspect, 0.016);
    motion.follow(person, kAspect, 0.016);
    EXPECT_NEAR(motion.camera().distance, before.distance, 0.1 * static_cast<double>(before.distance));
    EXPECT_LT(glm::distance(motion.camera().target, before.target), 0.1F);
}

TEST(CameraMotion, IsThereAtOnceAfterAJumpInTime) {
    constexpr double kJump = std::numeric_limits<double>::infinity();
    CameraMotion motion;
    motion.follow(std::array{personAt(0, 0)}, kAspect, 0);
    const render::Camera before = motion.camera();
    const std::array there{personAt(3, 1)};
    motion.follow(there, kAspect, kJump);
    EXPECT_LT(glm::distance(motion.camera().target, fitted(before, there, kAspect).target), 0.05F);
    const render::Camera after = motion.camera();
    motion.follow(std::array{personAt(3.05F, 1)}, kAspect, kJump);
    EXPECT_EQ(motion.camera(), after) << "who is well in the picture moves nothing";
}

TEST(CameraMotion, OrbitKeepsFollowing) {
    CameraMotion motion;
    const std::array there{personAt(5, 5)};
    motion.orbit({30, 10});
    motion.follow(there, kAspect, 1);
    EXPECT_NEAR(motion.camera().target.x, 5, 0.5);
}

TEST(CameraState, IsReadBackAsItWas) {
    CameraMotion motion;
    motion.orbit({120, -40});
    motion.zoom(3, {100, 100}, kView);
    motion.setProjection(render::Projection::Orthographic);
    CameraMotion other;
    restore(other, stateOf(motion));
    EXPECT_LT(glm::distance(other.camera().eye(), motion.camera().eye()), 1e-4F);
    EXPECT_EQ(other.camera().projection, render::Projection::Orthographic);
    EXPECT_FALSE(other.isFollowing()) << "the operator has zoomed";
    other.follow(std::array{personAt(20, 20)}, kAspect, 1);
    EXPECT_LT(glm::distance(other.camera().eye(), motion.camera().eye()), 1e-4F);
}

TEST(CameraState, OfOneThatFollowsChangesWithTheOperatorAlone) {
    CameraMotion motion;
    motion.follow(std::array{personAt(0, 0)}, kAspect, 1);
    const QJsonObject before = stateOf(motion);
    motion.follow(std::array{personAt(20, 20)}, kAspect, 1);
    EXPECT_EQ(stateOf(motion), before) << "settings are written when they change";
    motion.orbit({120, -40});
    EXPECT_NE(stateOf(motion), before);
}

TEST(CameraState, ThatMakesNoSenseIsHeldToWhatAnOperatorCanReach) {
    CameraMotion motion;
    restore(motion, QJsonObject{{"target", QJsonArray{1e30, "x"}},
                                {"yaw", 1e300},
                                {"pitch", -9.0},
                                {"distance", -3.0},
                                {"following", 7}});
    const render::Camera& camera = motion.camera();
    EXPECT_FLOAT_EQ(camera.target.x, 1'000.0F);
    EXPECT_FLOAT_EQ(camera.target.y, render::Camera().target.y);
    EXPECT_LE(std::abs(camera.yaw), 3.15F);
    EXPECT_GT(camera.pitch, -1.6F);
    EXPECT_GT(camera.distance, 0.1F);
    EXPECT_TRUE(motion.isFollowing());
}

} // namespace
} // namespace posewire::gui
