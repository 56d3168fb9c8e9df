// SPDX-License-Identifier: MIT
#include "core/model/body/joint_ranges.h"

#include "core/model/body/spaces.h"

#include <gtest/gtest.h>

#include <limits>

namespace posewire::model {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kAbduction = 0;
constexpr std::size_t kRotation = 1;
constexpr std::size_t kFlexion = 2;
constexpr std::size_t kRightShoulderJoint = 7;
constexpr std::size_t kRightKneeJoint = 15;
constexpr std::size_t kLeftKneeJoint = 19;

BodyAngles with(std::size_t joint, const Vector3d& degrees) {
    BodyAngles angles;
    angles.fill(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    angles[joint] = degrees * kRadiansPerDegree;
    return angles;
}
void expectRange(const AngleRange& range, double least, double most) {
    EXPECT_NEAR(range.least * kDegreesPerRadian, least, 1e-9);
    EXPECT_NEAR(range.most * kDegreesPerRadian, most, 1e-9);
}

TEST(ReferenceRanges, AreTheSameOnBothSides) {
    for (std::size_t joint = 0; joint < kBodyJointCount; ++joint) {
        std::string other(jointDefinitions()[joint].name);
        if (const auto at = other.find("Right"); at != std::string::npos) {
            other.replace(at, 5, "Left");
        }
        std::size_t place = 0;
        while (jointDefinitions()[place].name != other) {
            ++place;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto one = referenceRange(joint, axis);
            const auto mirrored = referenceRange(place, axis);
            ASSERT_EQ(one.has_value(), mirrored.has_value()) << other;
            EXPECT_TRUE(!one || (one->least == mirrored->least && one->most == mirrored->most)) << other;
            EXPECT_TRUE(!one || one->least < one->most) << other;
        }
    }
    expectRange(*referenceRange(kRightKneeJoint, kFlexion), -10, 135);
    EXPECT_FALSE(referenceRange(0, kFlexion)) << "no single joint of the spine";
}

TEST(JointExtents, HoldTheLeastAndTheMostOfEachJoint) {
    JointExtents extents;
    EXPECT_TRUE(extents.range(kLeftKneeJoint, kFlexion).isEmpty());
    extents.add(with(kLeftKneeJoint, {1, 2, 60}));
    extents.add(with(kLeftKneeJoint, {-3, 5, 10}));
    expectRange(extents.range(kLeftKneeJoint, kAbduction), -3, 1);
    expectRange(extents.range(kLeftKneeJoint, kRotation), 2, 5);
    expectRange(extents.range(kLeftKneeJoint, kFlexion), 10, 60);
    EXPECT_TRUE(extents.range(kRightKneeJoint, kFlexion).isEmpty());
    EXPECT_FALSE(extents.isBeyond(kLeftKneeJoint, kFlexion));

    JointExtents later;
    later.add(with(kLeftKneeJoint, {0, 0, 140}));
    later.add(extents);
    expectRange(later.range(kLeftKneeJoint, kFlexion), 10, 140);
    EXPECT_TRUE(later.isBeyond(kLeftKneeJoint, kFlexion));
    EXPECT_FALSE(later.isBeyond(kLeftKneeJoint, kRotation)) << "there is no reference";
    EXPECT_EQ(later.samples(), 3U);
}

TEST(JointExtents, TakeAnArmHeldUpForAbductionBeyondNinety) {
    JointExtents extents;
    extents.add(with(kRightShoulderJoint, {70, 10, 5}));
    extents.add(with(kRightShoulderJoint, {10, 180, -180})); // as type 20 has it: straight up
    expectRange(extents.range(kRightShoulderJoint, kAbduction), 70, 170);
    expectRange(extents.range(kRightShoulderJoint, kRotation), 0, 10);
    EXPECT_FALSE(extents.isBeyond(kRightShoulderJoint, kAbduction));
    EXPECT_FALSE(extents.isBeyond(kRightShoulderJoint, kRotation));
}

TEST(JointExtents, LeaveOutWhatMeansLittleNearTheGimbalLock) {
    JointExtents extents;
    extents.add(with(kRightShoulderJoint, {88, 160, 170}));
    expectRange(extents.range(kRightShoulderJoint, kAbduction), 92, 92);
    EXPECT_TRUE(extents.range(kRightShoulderJoint, kRotation).isEmpty());
    EXPECT_TRUE(extents.range(kRightShoulderJoint, kFlexion).isEmpty());
}

TEST(JointExtents, CountPronationOnThroughTheHalfTurn) {
    constexpr std::size_t kRightElbowJoint = 8;
    JointExtents extents;
    extents.add(with(kRightElbowJoint, {0, 168, 20}));
    extents.add(with(kRightElbowJoint, {0, -178, 20}));
    expectRange(extents.range(kRightElbowJoint, kRotation), 168, 182);
    EXPECT_TRUE(extents.isBeyond(kRightElbowJoint, kRotation));
}

} // namespace
} // namespace posewire::model
