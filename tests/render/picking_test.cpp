// SPDX-License-Identifier: MIT
#include "render/picking.h"

#include "render/mesh/mannequin.h"
#include "tests/render/poses.h"

#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render::test {
namespace {

const SegmentCapsules& mannequinCapsules() {
    static const SegmentCapsules kCapsules = segmentCapsules(loadMannequin(Detail::Medium));
    return kCapsules;
}

Ray towards(const glm::vec3& eye, const glm::vec3& point) {
    return {eye, glm::normalize(point - eye)};
}

TEST(Capsule, IsHitOnItsSideAndOnItsEnds) {
    const Capsule capsule{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, 0.1F};
    EXPECT_NEAR(intersect({{2, 0, 0.5F}, {-1, 0, 0}}, capsule).value_or(-1.0F), 1.9F, 1e-5F);
    EXPECT_NEAR(intersect({{0, 0, 3}, {0, 0, -1}}, capsule).value_or(-1.0F), 1.9F, 1e-5F);
    EXPECT_NEAR(intersect({{2, 0, 1.05F}, {-1, 0, 0}}, capsule).value_or(-1.0F), 2.0F - std::sqrt(0.0075F),
                1e-4F);
    EXPECT_NEAR(intersect({{0, 0, 0.5F}, {1, 0, 0}}, capsule).value_or(-1.0F), 0.0F, 1e-6F);
    EXPECT_FALSE(intersect({{2, 0.11F, 0.5F}, {-1, 0, 0}}, capsule).has_value());
    EXPECT_FALSE(intersect({{2, 0, 0.5F}, {1, 0, 0}}, capsule).has_value());
    EXPECT_FALSE(intersect({{2, 0, 0.5F}, {-1, 0, 0}}, Capsule{}).has_value());
}

TEST(SegmentCapsules, LieAboutEverySegment) {
    for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
        const Capsule& capsule = mannequinCapsules()[segment];
        EXPECT_GT(capsule.radius, 0.01F) << kJointNames[segment];
        EXPECT_LT(capsule.radius, 0.25F) << kJointNames[segment];
    }
}

TEST(Picking, FindsLimbsInAnyPose) {
    const Pose pose = placed(lungePose(), {1.0F, 2.0F, 0.0F}, 0.8F);
    const std::vector<DualQuaternion> palette = paletteOf(pose);
    const std::array<PickTarget, 1> targets{{{7, &mannequinCapsules(), palette}}};
    struct Case {
        Segment segment;
        Segment child;
        /// In the character's own frame, where nothing is in the way.
        glm::vec3 from;
    };
    const glm::quat turn = glm::angleAxis(0.8F, glm::vec3(0.0F, 0.0F, 1.0F));
    for (const auto& [segment, child, from] :
         {Case{LeftForeArm, LeftHand, {0.0F, 1.0F, 0.0F}}, Case{RightForeArm, RightHand, {1.0F, 0.0F, 0.2F}},
          Case{LeftLowerLeg, LeftFoot, {1.0F, 0.0F, 0.0F}},
          Case{RightLowerLeg, RightFoot, {-0.3F, -1.0F, 0.3F}}}) {
        const glm::vec3 middle = 0.5F * (pose.positions[segment] + pose.positions[child]);
        const auto pick = pickSegment(towards(middle + 3.0F * (turn * from), middle), targets);
        ASSERT_TRUE(pick.has_value()) << kJointNames[segment];
        EXPECT_EQ(pick->id, 7U);
        EXPECT_EQ(pick->segment, static_cast<int>(segment))
            << kJointNames[static_cast<std::size_t>(pick->segment)];
    }
}

TEST(Picking, PrefersTheNearerCharacter) {
    const std::vector<DualQuaternion> near = paletteOf(placed(tPose(), {1.0F, 0.0F, 0.0F}));
    const std::vector<DualQuaternion> far = paletteOf(tPose());
    const std::array<PickTarget, 2> targets{
        {{1, &mannequinCapsules(), far}, {2, &mannequinCapsules(), near}}};
    const auto pick = pickSegment({{5.0F, 0.0F, 1.65F}, {-1.0F, 0.0F, 0.0F}}, targets);
    ASSERT_TRUE(pick.has_value());
    EXPECT_EQ(pick->id, 2U);
    EXPECT_EQ(pick->segment, Head);
    EXPECT_NEAR(pick->distance, 3.9F, 0.05F);
}

TEST(Picking, FindsNothingBesideTheBody) {
    const std::vector<DualQuaternion> palette = paletteOf(tPose());
    const std::array<PickTarget, 3> targets{
        {{1, &mannequinCapsules(), palette}, {2, nullptr, palette}, {3, &mannequinCapsules(), {}}}};
    EXPECT_FALSE(pickSegment({{5.0F, 0.5F, 0.8F}, {-1.0F, 0.0F, 0.0F}}, targets).has_value());
    EXPECT_FALSE(pickSegment({{5.0F, 0.0F, 1.6F}, {1.0F, 0.0F, 0.0F}}, targets).has_value());
}

TEST(Capsule, IsHitAlongItsAxisAndFromInsideItsEnds) {
    const Capsule capsule{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, 0.1F};
    // Beside the axis and parallel to it only the end is in the way.
    EXPECT_NEAR(intersect({{0.06F, 0, 3}, {0, 0, -1}}, capsule).value_or(-1.0F), 1.92F, 1e-5F);
    EXPECT_FALSE(intersect({{0.2F, 0, 3}, {0, 0, -1}}, capsule).has_value());
    EXPECT_EQ(intersect({{0, 0, 1.05F}, {0, 0, 1}}, capsule).value_or(-1.0F), 0.0F);
    EXPECT_FALSE(intersect({{0, 0, 1.2F}, {0, 0, 1}}, capsule).has_value());
}

TEST(Capsule, WithoutLengthIsABall) {
    const Capsule ball{{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}, 0.5F};
    EXPECT_NEAR(intersect({{2, 0, 1}, {-1, 0, 0}}, ball).value_or(-1.0F), 1.5F, 1e-6F);
    EXPECT_FALSE(intersect({{2, 0.6F, 1}, {-1, 0, 0}}, ball).has_value());
}

TEST(Capsule, IsNeverHitWhereNumbersAreNotFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Ray ray{{2, 0, 0.5F}, {-1, 0, 0}};
    EXPECT_FALSE(intersect(ray, {{0, 0, 0}, {0, 0, 1}, nan}).has_value());
    EXPECT_FALSE(intersect(ray, {glm::vec3(nan), glm::vec3(nan), 0.1F}).has_value());
}

TEST(SegmentCapsules, AreAbsentWhereNoVertexFollowsASegment) {
    SkinnedMesh mesh;
    mesh.positions = {{0.0F, 0.0F, 1.0F}, {0.0F, 0.3F, 1.0F}, {0.1F, 0.0F, 1.0F}};
    mesh.joints.assign(3, {LeftUpperArm, kSegmentCount + 1, 200, 0});
    mesh.weights.assign(3, {0.2F, 0.3F, 0.5F, 0.0F});
    const SegmentCapsules capsules = segmentCapsules(mesh);
    // The twist joint of the left upper arm counts for its segment, a joint that does not exist for none.
    EXPECT_GT(capsules[LeftUpperArm].radius, 0.0F);
    EXPECT_LT(capsules[Pelvis].radius, 0.0F);
    EXPECT_LT(capsules[RightUpperArm].radius, 0.0F);
}

} // namespace
} // namespace posewire::render::test
