// SPDX-License-Identifier: MIT
#include "core/performer/character.h"
#include "core/performer/kinematics.h"
#include "core/performer/walk_clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace posewire::performer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using model::Side;
using namespace model::segment;

TEST(BodyPose, PutsSegmentsAtTheEndOfTheirParents) {
    const model::ReferenceBody body = model::makeReferenceBody();
    LocalRotations rotations;
    rotations[kLeftForeArm] = aboutZ(-90.0);
    const BodyPose pose = posed(body, body.origins[kPelvis], rotations);
    // The forearm of the T-pose bent forward by hand: the wrist is 0.235 m in front of the elbow.
    EXPECT_LT((pose[kLeftHand].position - Vector3d(0.235, 0.450, 1.4196)).norm(), 1e-9);
    EXPECT_LT((pose[kRightHand].position - body.origins[kRightHand]).norm(), 1e-9);
}

TEST(Leg, ReachesAnAnkleThatIsInReach) {
    const model::ReferenceBody body = model::makeReferenceBody();
    LocalRotations rotations;
    BodyPose pose = posed(body, body.origins[kPelvis], rotations);
    LegGoal goal;
    goal.ankle = Vector3d(0.25, -0.05, 0.20);
    goal.foot = aboutY(-15.0);
    reach(body, Side::Right, goal, rotations, pose);
    EXPECT_LT((pose[kRightFoot].position - goal.ankle).norm(), 1e-9);
    EXPECT_TRUE(pose[kRightFoot].orientation.isApprox(goal.foot));
    EXPECT_GT(pose[kRightLowerLeg].position.x(), 0.1) << "the knee points forward";
    EXPECT_LT((pose[kLeftFoot].position - body.origins[kLeftFoot]).norm(), 1e-12) << "the other leg stays";
}

TEST(Leg, StretchesTowardsAnAnkleOutOfReachWithoutLockingTheKnee) {
    const model::ReferenceBody body = model::makeReferenceBody();
    LocalRotations rotations;
    BodyPose pose = posed(body, body.origins[kPelvis], rotations);
    LegGoal goal;
    goal.ankle = body.origins[kRightFoot] - Vector3d(0.0, 0.0, 0.10);
    reach(body, Side::Right, goal, rotations, pose);
    const double span = (pose[kRightFoot].position - pose[kRightUpperLeg].position).norm();
    EXPECT_LT(span, body.legLength());
    EXPECT_GT(span, body.legLength() - 0.001);
    EXPECT_GT(rotations[kRightLowerLeg].y(), 0.0);
}

TEST(Leg, PutsTheSoleOfTheNullPoseOnTheFloor) {
    const model::ReferenceBody body = model::makeReferenceBody();
    const BodyPose pose = posed(body, body.origins[kPelvis], LocalRotations());
    for (const Vector3d& point : worldSolePoints(body, Side::Left, pose)) {
        EXPECT_NEAR(point.z(), 0.002, 1e-9);
    }
}

TEST(Kinematics, DifferentiatesAParabolaExactly) {
    const auto at = [](double t) { return Vector3d(1.0 + 2.0 * t, 3.0 * t * t, -0.5 * 9.81 * t * t); };
    const double h = 1.0 / 240.0;
    const PointState state = differentiated(at(0.5 - h), at(0.5), at(0.5 + h), h);
    EXPECT_LT((state.velocity - Vector3d(2.0, 3.0, -4.905)).norm(), 1e-9);
    EXPECT_LT((state.acceleration - Vector3d(0.0, 6.0, -9.81)).norm(), 1e-6);
}

TEST(Kinematics, FindsSteadyTurningWhateverTheSignsOfTheQuaternions) {
    const double h = 1.0 / 240.0;
    const Vector3d axis = Vector3d(1.0, -2.0, 0.5).normalized();
    const auto at = [&](double t) {
        return model::SegmentPose{Vector3d::Zero(),
                                  Quaterniond(Eigen::AngleAxisd(3.0 * t + 1.5 * t * t, axis))};
    };
    std::vector<model::SegmentPose> before{at(0.4 - h)};
    std::vector<model::SegmentPose> now{at(0.4)};
    std::vector<model::SegmentPose> after{at(0.4 + h)};
    now[0].orientation.coeffs() *= -1.0;
    std::vector<SegmentState> states(1);
    differentiate({before, now, after, h}, states);
    EXPECT_LT((states[0].angularVelocity - 4.2 * axis).norm(), 1e-6);
    EXPECT_LT((states[0].angularAcceleration - 3.0 * axis).norm(), 1e-5);
}

TEST(ExtraSegments, FollowTheHands) {
    const model::ReferenceBody body = model::makeReferenceBody();
    const model::SegmentLayout layout{model::kBodySegmentCount, 4, model::kFingerSegmentCount};
    LocalRotations rotations;
    rotations[kLeftUpperArm] = aboutX(-76.0);
    const BodyPose pose = posed(body, body.origins[kPelvis], rotations);
    std::vector<model::SegmentPose> poses(pose.begin(), pose.end());
    appendExtraSegments(layout, body, 0.4, poses);
    ASSERT_EQ(poses.size(), 67U);
    for (std::size_t index = 27; index < 47; ++index) {
        EXPECT_LT((poses[index].position - pose[kLeftHand].position).norm(), 0.2);
    }
    for (std::size_t index = 47; index < 67; ++index) {
        EXPECT_LT((poses[index].position - pose[kRightHand].position).norm(), 0.2);
    }
    EXPECT_LT((poses[23].position - pose[kRightHand].position).norm(), 0.2) << "a sword in the right hand";
}

TEST(ExtraSegments, MirrorTheHands) {
    const model::ReferenceBody body = model::makeReferenceBody();
    const model::SegmentLayout layout{model::kBodySegmentCount, 0, model::kFingerSegmentCount};
    const BodyPose pose = posed(body, body.origins[kPelvis], LocalRotations());
    std::vector<model::SegmentPose> poses(pose.begin(), pose.end());
    appendExtraSegments(layout, body, 0.7, poses);
    for (std::size_t index = 23; index < 43; ++index) {
        const Vector3d left = poses[index].position;
        EXPECT_LT((poses[index + 20].position - left.cwiseProduct(Vector3d(1.0, -1.0, 1.0))).norm(), 1e-9);
    }
    EXPECT_LT(poses[30].position.z(), pose[kLeftHand].position.z() - 0.02)
        << "fingers close downwards, palm down";
}

/// One foot after the other rests on the floor, moving backwards under the body, and swings forward in an
/// arc.
TEST(PelvisPath, RollsOverPointsThatRestOnTheFloor) {
    constexpr std::size_t kCount = 128;
    constexpr double kStride = 1.2;
    constexpr double kStance = 0.62;
    std::vector<SoleFrame> soles(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        const double phase = static_cast<double>(i) / kCount;
        for (std::size_t foot = 0; foot < 2; ++foot) {
            const double own = foot == 0 ? phase : std::fmod(phase + 0.5, 1.0);
            const double swing = std::max(0.0, (own - kStance) / (1.0 - kStance));
            const double x = own < kStance ? kStride * (0.31 - own) : kStride * 0.31 * (2.0 * swing - 1.0);
            const double z = -0.9 + 0.05 * std::pow(std::sin(std::numbers::pi * swing), 2);
            soles[i][foot].fill(Vector3d(x, 0.0, z));
        }
    }
    const PelvisPath path = pelvisPath(soles);
    EXPECT_NEAR(path.strideLength, kStride, 0.005);
    ASSERT_EQ(path.roots.size(), kCount);
    for (const Vector3d& root : path.roots) {
        EXPECT_NEAR(root.z(), 0.9, 0.005);
        EXPECT_LT(std::abs(root.x()), 0.01);
    }
}

} // namespace
} // namespace posewire::performer
