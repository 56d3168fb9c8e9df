// SPDX-License-Identifier: MIT
#include "core/model/body/joint_angles.h"

#include "core/model/body/spaces.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace posewire::model
