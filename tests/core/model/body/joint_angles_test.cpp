// SPDX-License-Identifier: MIT
#include "core/model/body/joint_angles.h"

#include "core/model/body/character_pose.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <vector>

namespace posewire::model {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using namespace segment;

Quaterniond about(const Vector3d& axis, double degrees) {
    return Quaterniond(Eigen::AngleAxisd(degrees * kRadiansPerDegree, axis));
}
const Vector3d kX = Vector3d::UnitX();
const Vector3d kY = Vector3d::UnitY();
const Vector3d kZ = Vector3d::UnitZ();

class JointAngles : public testing::Test {
protected:
    std::vector<Quaterniond> m_orientations =
        std::vector<Quaterniond>(kBodySegmentCount, Quaterniond::Identity());
    std::vector<Vector3d> m_angles = std::vector<Vector3d>(kJointCount);

    /// Turns a segment and everything that hangs on it.
    void turn(int index, const Quaterniond& rotation) {
        m_orientations[static_cast<std::size_t>(index)] =
            rotation * m_orientations[static_cast<std::size_t>(index)];
        for (int child = index + 1; child < kBodySegmentCount; ++child) {
            if (bodySegments()[static_cast<std::size_t>(child)].parent == index) {
                turn(child, rotation);
            }
        }
    }
    /// In degrees.
    Vector3d angle(std::string_view joint) {
        jointAngles(m_orientations, m_angles);
        for (std::size_t row = 0; row < kJointCount; ++row) {
            if (jointDefinitions()[row].name == joint) {
                return m_angles[row] * kDegreesPerRadian;
            }
        }
        ADD_FAILURE() << "no joint " << joint;
        return Vector3d::Zero();
    }
    static void expectNear(const Vector3d& value, const Vector3d& expected) {
        EXPECT_LT((value - expected).norm(), 1e-9)
            << value.transpose() << " instead of " << expected.transpose();
    }
};

TEST_F(JointAngles, NumbersPointsAsRecordedStreamsDo) {
    const auto& joints = jointDefinitions();
    const auto id = [](const PointReference& point) { return encodePointId(PointIdCoding::By256, point); };
    EXPECT_EQ(id(joints[0].parent), 258U);
    EXPECT_EQ(id(joints[0].child), 513U);
    EXPECT_EQ(id(joints[15].parent), 256U * 16 + 2);
    EXPECT_EQ(id(joints[15].child), 256U * 17 + 1);
    EXPECT_EQ(id(joints[18].parent), 256U * 1 + 4);
    EXPECT_EQ(joints[25].parent, joints[27].parent);
    EXPECT_EQ(joints[25].child, joints[27].child) << "two ergonomic angles share their IDs";
}

TEST_F(JointAngles, NamesPointsThatExist) {
    for (const JointDefinition& joint : jointDefinitions()) {
        for (const PointReference& point : {joint.parent, joint.child}) {
            EXPECT_TRUE(point.localId == 0 || findPoint(point.segmentId - 1, point.localId) != nullptr);
        }
    }
}

TEST_F(JointAngles, AreZeroInTheTPoseButForTheArmsHeldOut) {
    // The zero of the shoulder is the hanging arm, so a T-pose is 90° of abduction.
    jointAngles(m_orientations, m_angles);
    for (std::size_t row = 0; row < kJointCount; ++row) {
        const std::string_view name = jointDefinitions()[row].name;
        if (name.find("Shoulder") == std::string_view::npos &&
            name.find("UpperArm") == std::string_view::npos && name.find("Elbow") == std::string_view::npos &&
            name.find("Wrist") == std::string_view::npos) {
            EXPECT_LT(m_angles[row].norm(), 1e-9) << name;
        }
    }
    EXPECT_NEAR(angle("jRightShoulder").x(), 90.0, 1e-6);
    EXPECT_NEAR(angle("jLeftShoulder").x(), 90.0, 1e-6);
}

TEST_F(JointAngles, CountKneeAndHipFlexionPositive) {
    turn(kRightUpperLeg, about(kY, -30.0));
    turn(kRightLowerLeg, about(kY, 60.0));
    expectNear(angle("jRightHip"), {0.0, 0.0, 30.0});
    expectNear(angle("jRightKnee"), {0.0, 0.0, 60.0});
    turn(kLeftUpperLeg, about(kY, -25.0));
    turn(kLeftLowerLeg, about(kY, 50.0));
    expectNear(angle("jLeftHip"), {0.0, 0.0, 25.0});
    expectNear(angle("jLeftKnee"), {0.0, 0.0, 50.0});
}

TEST_F(JointAngles, CountDorsiflexionPositive) {
    turn(kRightFoot, about(kY, -12.0));
    turn(kLeftFoot, about(kY, 18.0));
    expectNear(angle("jRightAnkle"), {0.0, 0.0, 12.0});
    expectNear(angle("jLeftAnkle"), {0.0, 0.0, -18.0});
}

TEST_F(JointAngles, CountAbductionPositiveOnBothSides) {
    // Outwards: the right leg turns about the x-axis the one way, the left the other way.
    turn(kRightUpperLeg, about(kX, -20.0));
    turn(kLeftUpperLeg, about(kX, 20.0));
    expectNear(angle("jRightHip"), {20.0, 0.0, 0.0});
    expectNear(angle("jLeftHip"), {20.0, 0.0, 0.0});
    // Arms let down by 76° from the T-pose are 14° off the body.
    turn(kRightUpperArm, about(kX, 76.0));
    turn(kLeftUpperArm, about(kX, -76.0));
    expectNear(angle("jRightShoulder"), {14.0, 0.0, 0.0});
    expectNear(angle("jLeftShoulder"), {14.0, 0.0, 0.0});
}

TEST_F(JointAngles, CountInternalRotationPositiveOnBothSides) {
    turn(kRightUpperLeg, about(kZ, 15.0));
    turn(kLeftUpperLeg, about(kZ, -15.0));
    expectNear(angle("jRightHip"), {0.0, 15.0, 0.0});
    expectNear(angle("jLeftHip"), {0.0, 15.0, 0.0});
}

TEST_F(JointAngles, CountElbowFlexionPositiveOnBothSides) {
    // Forearms to the front of the T-pose.
    turn(kRightForeArm, about(kZ, 80.0));
    turn(kLeftForeArm, about(kZ, -80.0));
    EXPECT_NEAR(angle("jRightElbow").z(), 80.0, 1e-9);
    EXPECT_NEAR(angle("jLeftElbow").z(), 80.0, 1e-9);
}

TEST_F(JointAngles, SeparateThreeAnglesInTheOrderZXY) {
    // Ry(b) · Rx(a) · Rz(c) read back component by component; spine joints carry no sign.
    turn(kL5, about(kY, 25.0) * about(kX, -10.0) * about(kZ, 40.0));
    expectNear(angle("jL5S1"), {-10.0, 40.0, 25.0});
}

TEST_F(JointAngles, DoNotDependOnWhereThePersonFaces) {
    turn(kRightLowerLeg, about(kY, 60.0));
    turn(kT8, about(kY, 20.0) * about(kX, 5.0));
    const Vector3d before = angle("jRightKnee");
    const Vector3d vertical = angle("Vertical_T8");
    turn(kPelvis, about(kZ, 130.0));
    expectNear(angle("jRightKnee"), before);
    expectNear(angle("Vertical_T8"), vertical);
}

TEST_F(JointAngles, MeasureTheTrunkAgainstTheVertical) {
    turn(kPelvis, about(kY, 12.0));
    expectNear(angle("Vertical_Pelvis"), {0.0, 0.0, 12.0});
    expectNear(angle("Vertical_T8"), {0.0, 0.0, 12.0});
    expectNear(angle("Pelvis_T8"), {0.0, 0.0, 0.0});
}

TEST_F(JointAngles, OfArmsThatHangAtRestAreThoseOfArmsHeldOut) {
    // The same posture in both conventions: turned from the T-pose, and from arms that hang with the palms to
    // the front.
    turn(kRightUpperArm, about(kX, 60.0) * about(kY, -20.0));
    turn(kLeftForeArm, about(kZ, -70.0));
    jointAngles(m_orientations, m_angles);
    std::vector<Quaterniond> hanging = m_orientations;
    for (int segment = 0; segment < kBodySegmentCount; ++segment) {
        hanging[static_cast<std::size_t>(segment)] *= isbFrame(segment);
    }
    std::vector<Vector3d> same(kJointCount);
    jointAngles(hanging, same, Stance::N);
    for (std::size_t row = 0; row < kJointCount; ++row) {
        expectNear(same[row], m_angles[row]);
    }
}

TEST(JointStance, FollowsWhereTheForearmBegins) {
    std::array<Vector3d, kBodySegmentCount> origins = referenceOrigins();
    EXPECT_EQ(stanceOf(origins), Stance::T);
    origins[kRightForeArm] = origins[kRightUpperArm] + Vector3d(0.02, -0.05, -0.3);
    EXPECT_EQ(stanceOf(origins), Stance::N);
}

/// Rotation matrices written out, apart from Eigen's.
Eigen::Matrix3d turnByHand(double x, double y, double z) {
    Eigen::Matrix3d aboutX;
    Eigen::Matrix3d aboutY;
    Eigen::Matrix3d aboutZ;
    aboutX << 1, 0, 0, 0, std::cos(x), -std::sin(x), 0, std::sin(x), std::cos(x);
    aboutY << std::cos(y), 0, std::sin(y), 0, 1, 0, -std::sin(y), 0, std::cos(y);
    aboutZ << std::cos(z), -std::sin(z), 0, std::sin(z), std::cos(z), 0, 0, 0, 1;
    return aboutY * aboutX * aboutZ;
}

TEST(JointTurn, IsWhatAnglesAreTakenFrom) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> angle(-1.5, 1.5);
    for (const JointDefinition& joint : std::span(jointDefinitions()).first<kBodyJointCount>()) {
        const Vector3d angles(angle(random), 2 * angle(random), 2 * angle(random));
        const Eigen::Matrix3d byHand =
            turnByHand(joint.signs[0] * angles.x(), joint.signs[2] * angles.z(), joint.signs[1] * angles.y());
        EXPECT_LT((jointTurn(joint, angles).toRotationMatrix() - byHand).norm(), 1e-12) << joint.name;
        const Vector3d read = jointAngle(joint, Quaterniond::Identity(), jointTurn(joint, angles), Stance::N);
        EXPECT_LT((read - angles).norm(), 1e-9) << joint.name;
        EXPECT_LT(jointDifference(joint, equalForms(angles)[1], angles), 1e-7) << joint.name;
        EXPECT_NEAR(jointDifference(joint, angles + Vector3d(0, 0, 0.1), angles), 0.1, 1e-9) << joint.name;
    }
}

TEST(GimbalLock, IsNearWithinFiveDegrees) {
    for (const double sense : {1.0, -1.0}) {
        EXPECT_FALSE(isNearGimbalLock(Vector3d(sense * 84.9, 0, 0) * kRadiansPerDegree));
        EXPECT_TRUE(isNearGimbalLock(Vector3d(sense * 85.1, 0, 0) * kRadiansPerDegree));
        EXPECT_TRUE(isNearGimbalLock(Vector3d(sense * 94.9, 0, 0) * kRadiansPerDegree));
    }
    EXPECT_FALSE(isNearGimbalLock(Vector3d(0, 1.57, 1.57)));
}

TEST(GimbalLock, LetsAnArmPassStraightThroughWithoutAJump) {
    // Both arms from 60° to 120° of abduction, right through 90°: what jointAngle() gives jumps by 180°.
    for (const std::size_t row : {7U, 11U}) {
        const JointDefinition& joint = jointDefinitions()[row];
        Vector3d before = Vector3d(60, 20, 10) * kRadiansPerDegree;
        double jump = 0;
        for (double degrees = 60; degrees <= 120; degrees += 0.25) {
            const Vector3d performed = Vector3d(degrees, 20, 10) * kRadiansPerDegree;
            const Quaterniond turn = jointTurn(joint, performed);
            const Vector3d read = jointAngle(joint, Quaterniond::Identity(), turn, Stance::N);
            jump = std::max(jump, (read - before).cwiseAbs().maxCoeff());
            before = closestAngles(joint, read, before);
            EXPECT_LT((before - performed).norm(), 1e-6) << degrees;
            EXPECT_LT(jointDifference(joint, before, performed), 1e-6);
        }
        EXPECT_GT(jump, std::numbers::pi / 2);
    }
}

TEST(GimbalLock, SharesOutATurnThatHasNoPartsOfItsOwn) {
    for (const double abduction : {90.0, -90.0}) {
        for (const JointDefinition& joint : std::span(jointDefinitions()).first<kBodyJointCount>()) {
            const Vector3d before = Vector3d(abduction, 35, -20) * kRadiansPerDegree;
            const Quaterniond turn =
                jointTurn(joint, before + Vector3d(0, 2, 0) * kRadiansPerDegree); // one degree each
            const Vector3d read = jointAngle(joint, Quaterniond::Identity(), turn, Stance::N);
            const Vector3d now = closestAngles(joint, read, before);
            EXPECT_LT((now - before).cwiseAbs().maxCoeff(), 1.01 * kRadiansPerDegree) << joint.name;
            EXPECT_LT(turn.angularDistance(jointTurn(joint, now)), 1e-6) << joint.name;
        }
    }
}

TEST(BodyAnglesTest, AreReadByPointsInWhateverOrder) {
    wire::JointAngles message;
    const auto add = [&](int row, wire::Vec3 rotation) {
        const JointDefinition& joint = jointDefinitions()[static_cast<std::size_t>(row)];
        message.joints.push_back({encodePointId(PointIdCoding::By256, joint.parent),
                                  encodePointId(PointIdCoding::By256, joint.child), rotation});
    };
    add(15, {1, 2, 60});
    add(25, {7, 7, 7}); // an ergonomic angle
    add(0, {3, 4, 5});
    const BodyAngles angles = anglesOf(message);
    EXPECT_LT((angles[15] * kDegreesPerRadian - Vector3d(1, 2, 60)).norm(), 1e-5);
    EXPECT_LT((angles[0] * kDegreesPerRadian - Vector3d(3, 4, 5)).norm(), 1e-5);
    EXPECT_EQ(std::ranges::count_if(angles, [](const Vector3d& one) { return one.allFinite(); }), 2);
}

TEST(BodyAnglesTest, AreUnknownWhereASegmentIs) {
    CharacterPose pose;
    pose.segments.resize(kBodySegmentCount);
    pose.sources.assign(kBodySegmentCount, {Provenance::Sent, Provenance::Sent});
    pose.segments[kRightLowerLeg].orientation = about(kY, 60.0);
    EXPECT_NEAR(anglesOf(pose, Stance::T)[15].z() * kDegreesPerRadian, 60.0, 1e-9);
    pose.sources[kRightLowerLeg].orientation = Provenance::None;
    EXPECT_FALSE(anglesOf(pose, Stance::T)[15].allFinite());
    EXPECT_FALSE(anglesOf(pose, Stance::T)[16].allFinite());
    EXPECT_TRUE(anglesOf(pose, Stance::T)[14].allFinite());
    pose.isObjects = true;
    EXPECT_FALSE(anglesOf(pose, Stance::T)[14].allFinite());
}

} // namespace
} // namespace posewire::model
