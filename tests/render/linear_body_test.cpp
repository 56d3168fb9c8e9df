// SPDX-License-Identifier: MIT
#include "render/mesh/linear_body.h"
#include "render/mesh/mannequin.h"
#include "tests/render/poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

constexpr glm::vec3 kX(1.0F, 0.0F, 0.0F);
constexpr glm::vec3 kY(0.0F, 1.0F, 0.0F);
constexpr glm::vec3 kZ(0.0F, 0.0F, 1.0F);

glm::quat turn(float degrees, const glm::vec3& axis) {
    return glm::angleAxis(degrees * std::numbers::pi_v<float> / 180.0F, axis);
}

/// As other programs skin it: matrices, weighed.
std::vector<glm::vec3> blendedLinearly(const LinearBody& body, std::span<const DualQuaternion> palette) {
    std::vector<LinearPlace> places;
    for (const LinearJoint& joint : body.joints) {
        places.push_back(placeOf(joint, palette));
    }
    std::vector<glm::vec3> positions;
    for (std::size_t i = 0; i < body.mesh.vertexCount(); ++i) {
        glm::vec3 sum(0.0F);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t joint = body.mesh.joints[i][k];
            sum += body.mesh.weights[i][static_cast<int>(k)] *
                   (places[joint].position +
                    places[joint].orientation * (body.mesh.positions[i] - body.joints[joint].origin));
        }
        positions.push_back(sum);
    }
    return positions;
}

class LinearBodyTest : public testing::Test {
protected:
    /// Both legs move it, which may swing by two right angles against each other: between the thighs.
    [[nodiscard]] bool isBetweenLegs(std::size_t vertex) const {
        bool isRight = false;
        bool isLeft = false;
        for (int k = 0; k < 4; ++k) {
            const Segment segment = jointSegment(m_mesh.joints[vertex][static_cast<std::size_t>(k)]);
            isRight = isRight || (m_mesh.weights[vertex][k] > 0.0F && segment == RightUpperLeg);
            isLeft = isLeft || (m_mesh.weights[vertex][k] > 0.0F && segment == LeftUpperLeg);
        }
        return isRight && isLeft;
    }
    /// Greatest distance in metres between a vertex as other programs and as the window draw it.
    [[nodiscard]] float greatestDistance(const LinearBody& body,
                                         std::span<const DualQuaternion> palette) const {
        std::vector<glm::vec3> drawn(m_mesh.vertexCount());
        std::vector<glm::vec3> normals(m_mesh.vertexCount());
        SkinJob{&m_mesh, palette, drawn, normals}.run();
        const std::vector<glm::vec3> blended = blendedLinearly(body, palette);
        float most = 0.0F;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            const float distance = glm::distance(drawn[i], blended[i]);
            EXPECT_LT(distance, 0.045F);
            most = isBetweenLegs(i) ? most : std::max(most, distance);
        }
        return most;
    }
    [[nodiscard]] LinearBody body(bool hasFingers) const {
        return linearBody(m_mesh, fitBody(kReferenceNullPose), hasFingers, hasFingers);
    }

    SkinnedMesh m_mesh = loadMannequin(Detail::Medium);
};

TEST_F(LinearBodyTest, KeepsTheFormOfTheWindowInExtremePoses) {
    const LinearBody linear = body(false);
    const std::vector<test::LocalRotations> bent{
        {{RightForeArm, turn(125.0F, kZ)}, {LeftForeArm, turn(-140.0F, kZ)}},
        {{RightLowerLeg, turn(110.0F, kY)}, {LeftLowerLeg, turn(140.0F, kY)}},
        {{RightForeArm, turn(90.0F, kY)}, {LeftForeArm, turn(-90.0F, kY)}},
        {{RightUpperArm, turn(80.0F, kY)}, {RightHand, turn(75.0F, kX)}, {Head, turn(60.0F, kZ)}},
        {{RightUpperLeg, turn(-100.0F, kY)}, {LeftFoot, turn(45.0F, kY)}},
    };
    for (const test::LocalRotations& rotations : bent) {
        EXPECT_LT(greatestDistance(linear, test::paletteOf(test::poseFrom(rotations))), 0.006F);
    }
    for (const test::Pose& pose : {test::squatPose(), test::elbowPose(), test::shrugPose(), test::lungePose(),
                                   test::raisedArmsPose(), test::spreadLegsPose(), test::nodPose()}) {
        EXPECT_LT(greatestDistance(linear, test::paletteOf(pose)), 0.012F);
    }
}

TEST_F(LinearBodyTest, MovesFingersThatAreSent) {
    const LinearBody linear = body(true);
    EXPECT_LT(greatestDistance(linear, test::fist(test::tPose())), 0.004F);
    std::set<std::string> names;
    for (const LinearJoint& joint : linear.joints) {
        EXPECT_TRUE(names.insert(joint.name).second) << joint.name;
        EXPECT_EQ(joint.isSegment, joint.name == kJointNames[joint.segment]);
    }
    EXPECT_TRUE(names.contains("RightThirdDP"));
    EXPECT_TRUE(names.contains("RightForeArm bend 2"));
}

TEST_F(LinearBodyTest, RestsHandsWithoutFingers) {
    const LinearBody linear = body(false);
    for (const LinearJoint& joint : linear.joints) {
        EXPECT_LT(joint.segment, kSegmentCount) << joint.name;
    }
    EXPECT_LT(greatestDistance(linear, test::paletteOf(test::tPose())), 1e-4F);
}

TEST_F(LinearBodyTest, StandsStillAtRestAndAddsUp) {
    const LinearBody linear = body(true);
    EXPECT_TRUE(linear.mesh.validate(linear.joints.size()));
    for (const JointIndices& joints : linear.mesh.joints) {
        for (std::size_t k = 1; k < 4; ++k) {
            EXPECT_TRUE(joints[k] == 0 || std::ranges::count(joints, joints[k]) == 1);
        }
    }
}

/// Their nodes have rotations alone.
TEST_F(LinearBodyTest, ShiftsJointsOfShouldersAlone) {
    const LinearBody linear = body(false);
    const test::Pose pose = test::raisedArmsPose();
    const auto palette = test::paletteOf(pose);
    bool isAnyShifted = false;
    for (const LinearJoint& joint : linear.joints) {
        const float off = glm::distance(placeOf(joint, palette).position, pose.positions[joint.segment]);
        EXPECT_TRUE(joint.isShifted || off < 1e-5F) << joint.name << ' ' << off;
        isAnyShifted = isAnyShifted || (joint.isShifted && off > 0.001F);
    }
    EXPECT_TRUE(isAnyShifted);
}

} // namespace
} // namespace posewire::render
