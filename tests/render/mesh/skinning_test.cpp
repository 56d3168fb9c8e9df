// SPDX-License-Identifier: MIT
#include "render/mesh/mannequin.h"
#include "render/skinning.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const glm::quat kIdentity(1.0F, 0.0F, 0.0F, 0.0F);
const glm::vec3 kX(1.0F, 0.0F, 0.0F);
const glm::vec3 kY(0.0F, 1.0F, 0.0F);
const glm::vec3 kZ(0.0F, 0.0F, 1.0F);

glm::quat turn(float degrees, const glm::vec3& axis) {
    return glm::angleAxis(degrees * std::numbers::pi_v<float> / 180.0F, axis);
}

/// A pose built along the hierarchy from local rotations, starting from the reference null pose.
struct Pose {
    std::array<glm::quat, kSegmentCount> local;
    std::array<glm::vec3, kSegmentCount> positions = kReferenceNullPose;
    std::array<glm::quat, kSegmentCount> orientations;

    Pose() {
        local.fill(kIdentity);
        orientations.fill(kIdentity);
    }

    void update() {
        orientations[0] = local[0];
        for (std::size_t i = 1; i < kSegmentCount; ++i) {
            const auto parent = static_cast<std::size_t>(kSegmentParents[i]);
            orientations[i] = orientations[parent] * local[i];
            positions[i] = positions[parent] +
                           orientations[parent] * (kReferenceNullPose[i] - kReferenceNullPose[parent]);
        }
    }

    /// With straight fingers.
    std::array<DualQuaternion, kJointCount> palette() const {
        std::array<DualQuaternion, kJointCount> result;
        PaletteJob job{positions, orientations, kReferenceNullPose, result};
        const Hand left(*this, LeftHand);
        const Hand right(*this, RightHand);
        job.leftHand = {left.positions, left.orientations};
        job.rightHand = {right.positions, right.orientations};
        EXPECT_TRUE(job.validate());
        job.run();
        return result;
    }

    /// The fingers as the hand has them in the null pose.
    struct Hand {
        std::array<glm::vec3, kHandSegmentCount> positions;
        std::array<glm::quat, kHandSegmentCount> orientations;

        Hand(const Pose& pose, Segment hand) {
            const std::size_t first = kFirstFingerJoint + (hand == LeftHand ? 0U : kHandSegmentCount);
            for (std::size_t i = 0; i < kHandSegmentCount; ++i) {
                orientations[i] = pose.orientations[hand];
                positions[i] = pose.positions[hand] +
                               orientations[i] * (jointOrigin(first + i) - kReferenceNullPose[hand]);
            }
        }
    };
};

Pose bentPose() {
    Pose pose;
    pose.positions[Pelvis] = {3.0F, -2.0F, 1.1F};
    pose.local[Pelvis] = turn(130.0F, kZ);
    pose.local[LeftUpperArm] = turn(-60.0F, kX) * turn(40.0F, kY);
    pose.local[LeftForeArm] = turn(-80.0F, kZ) * turn(90.0F, kY);
    pose.local[RightUpperLeg] = turn(-70.0F, kY) * turn(25.0F, kZ);
    pose.local[RightLowerLeg] = turn(90.0F, kY);
    pose.update();
    return pose;
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Palette, IsTheIdentityInTheNullPose) {
    for (const DualQuaternion& joint : Pose().palette()) {
        expectNear(transformPoint(joint, {0.3F, -0.4F, 1.2F}), {0.3F, -0.4F, 1.2F}, 1e-6F);
    }
}

TEST(Palette, MovesEachPointRigidlyWithItsSegment) {
    const Pose pose = bentPose();
    const auto palette = pose.palette();
    const glm::vec3 point(0.1F, 0.2F, 0.9F);
    for (std::size_t i = 0; i < kSegmentCount; ++i) {
        const glm::vec3 expected = pose.orientations[i] * (point - kReferenceNullPose[i]) + pose.positions[i];
        expectNear(transformPoint(palette[i], point), expected, 2e-6F);
    }
}

TEST(Palette, KeepsUnitLengthAndSignsAlongTheHierarchy) {
    Pose pose = bentPose();
    pose.orientations[LeftForeArm] = -pose.orientations[LeftForeArm];
    pose.orientations[Neck] = -pose.orientations[Neck];
    const auto palette = pose.palette();
    for (std::size_t i = 0; i < kJointCount; ++i) {
        EXPECT_NEAR(glm::length(palette[i].real), 1.0F, 1e-6F);
        EXPECT_NEAR(glm::dot(palette[i].real, palette[i].dual), 0.0F, 1e-5F);
        const int parent = jointParent(i);
        if (parent >= 0) {
            EXPECT_GE(glm::dot(palette[i].real, palette[static_cast<std::size_t>(parent)].real), 0.0F);
        }
    }
}

TEST(Palette, LeavesPureTwistOutOfTheTwistJoint) {
    Pose pose;
    pose.local[RightForeArm] = turn(150.0F, kY);
    pose.update();
    const auto palette = pose.palette();
    const glm::vec3 point = kReferenceNullPose[RightForeArm] + glm::vec3(0.03F, -0.02F, 0.01F);
    const std::size_t twist = kSegmentCount + 2;
    ASSERT_EQ(jointSegment(twist), RightForeArm);
    expectNear(transformPoint(palette[twist], point), point, 1e-6F);
    EXPECT_GT(glm::distance(transformPoint(palette[RightForeArm], point), point), 0.03F);
}

TEST(Palette, GivesPureSwingWholeToTheTwistJoint) {
    Pose pose;
    pose.local[LeftForeArm] = turn(-75.0F, kZ);
    pose.local[LeftUpperLeg] = turn(-60.0F, kY) * turn(0.0F, kZ);
    pose.update();
    const auto palette = pose.palette();
    const glm::vec3 point(0.05F, 0.5F, 1.0F);
    expectNear(transformPoint(palette[kSegmentCount + 3], point), transformPoint(palette[LeftForeArm], point),
               1e-6F);
    expectNear(transformPoint(palette[kSegmentCount + 5], point),
               transformPoint(palette[LeftUpperLeg], point), 1e-6F);
}

TEST(Palette, KeepsTwistJointsAtTheEndOfTheBone) {
    const Pose pose = bentPose();
    const auto palette = pose.palette();
    for (std::size_t i = 0; i < kTwistJointCount; ++i) {
        const auto& [segment, axis] = kTwistJoints[i];
        const glm::vec3 end = kReferenceNullPose[segment] + 0.3F * axis;
        expectNear(transformPoint(palette[kSegmentCount + i], end), transformPoint(palette[segment], end),
                   1e-5F);
    }
}

TEST(Palette, GivesHalfOfTheSwingToHalfJoints) {
    Pose pose;
    pose.local[LeftUpperLeg] = turn(-80.0F, kY) * turn(30.0F, kZ);
    pose.update();
    const auto palette = pose.palette();
    const DualQuaternion& half = palette[kFirstHalfJoint + 3];
    ASSERT_EQ(jointSegment(kFirstHalfJoint + 3), LeftUpperLeg);
    const glm::quat rotation(half.real.w, half.real.x, half.real.y, half.real.z);
    expectNear(rotation * kX, turn(-40.0F, kY) * kX, 1e-6F);
}

TEST(Palette, MovesFingersAsTheyAreSent) {
    const Pose pose = bentPose();
    Pose::Hand hand(pose, LeftHand);
    const std::size_t finger = 6; // SecondMP
    hand.orientations[finger] = turn(-50.0F, kX) * hand.orientations[finger];
    hand.positions[finger] += glm::vec3(0.01F, 0.02F, 0.03F);
    hand.orientations[finger + 1] = glm::quat(kNan, kNan, kNan, kNan);
    hand.positions[finger + 1] = glm::vec3(kNan);
    std::array<DualQuaternion, kJointCount> palette;
    PaletteJob job{pose.positions, pose.orientations, kReferenceNullPose, palette};
    job.leftHand = {hand.positions, hand.orientations};
    ASSERT_TRUE(job.validate());
    job.run();
    const std::size_t joint = kFirstFingerJoint + finger;
    const glm::vec3 point = jointOrigin(joint) + glm::vec3(0.004F, 0.01F, -0.003F);
    expectNear(transformPoint(palette[joint], point),
               hand.positions[finger] + hand.orientations[finger] * (point - jointOrigin(joint)), 2e-6F);
    // What is missing hangs on its parent as in the null pose.
    expectNear(transformPoint(palette[joint + 1], point), transformPoint(palette[joint], point), 2e-6F);
}

TEST(Palette, RelaxesFingersThatAreNotKnownAlikeOnBothSides) {
    Pose pose;
    std::array<DualQuaternion, kJointCount> palette;
    PaletteJob{pose.positions, pose.orientations, kReferenceNullPose, palette}.run();
    for (std::size_t finger = 0; finger < kHandSegmentCount; ++finger) {
        const std::size_t left = kFirstFingerJoint + finger;
        const glm::vec3 point = jointOrigin(left) + glm::vec3(0.004F, 0.01F, -0.003F);
        const glm::vec3 mirror(1.0F, -1.0F, 1.0F);
        expectNear(mirror * transformPoint(palette[left + kHandSegmentCount], mirror * point),
                   transformPoint(palette[left], point), 2e-6F);
    }
    const glm::vec3 tip = kReferenceFingertips[2];
    EXPECT_LT(transformPoint(palette[kFirstFingerJoint + 11], tip).z, tip.z - 0.03F) << "towards the palm";
}

TEST(Palette, StaysFiniteForNonsense) {
    Pose pose = bentPose();
    pose.orientations[LeftForeArm] = glm::quat(0.0F, 0.0F, 0.0F, 0.0F);
    pose.orientations[Pelvis] = glm::quat(kNan, 0.0F, 0.0F, 0.0F);
    pose.orientations[T8] = glm::quat(1e30F, 1e30F, 0.0F, 0.0F);
    pose.positions[LeftHand] = glm::vec3(kNan);
    pose.positions[Pelvis].x = std::numeric_limits<float>::infinity();
    for (const DualQuaternion& joint : pose.palette()) {
        EXPECT_NEAR(glm::length(joint.real), 1.0F, 1e-5F);
        EXPECT_TRUE(std::isfinite(glm::length(joint.dual)));
    }
}

TEST(Palette, PutsASegmentWithoutPlaceAtItsOffsetFromTheParent) {
    Pose pose = bentPose();
    const glm::vec3 expected = pose.positions[LeftHand];
    pose.positions[LeftHand] = glm::vec3(kNan);
    expectNear(transformPoint(pose.palette()[LeftHand], kReferenceNullPose[LeftHand]), expected, 1e-5F);
}

TEST(Palette, RefusesSpansOfTheWrongSize) {
    const Pose pose;
    std::array<DualQuaternion, kJointCount> palette;
    PaletteJob job{pose.positions, pose.orientations, kReferenceNullPose, palette};
    EXPECT_TRUE(job.validate());
    job.palette = job.palette.first(kSegmentCount);
    EXPECT_FALSE(job.validate());
    job.palette = palette;
    job.positions = job.positions.first(22);
    EXPECT_FALSE(job.validate());
    job.positions = pose.positions;
    const Pose::Hand hand(pose, RightHand);
    job.rightHand = {hand.positions, hand.orientations};
    EXPECT_TRUE(job.validate());
    job.rightHand.orientations = job.rightHand.orientations.first(19);
    EXPECT_FALSE(job.validate());
    job.rightHand = {};
    job.fingerOrigins = hand.positions;
    EXPECT_FALSE(job.validate());
}

class SkinTest : public testing::Test {
protected:
    SkinnedMesh skinned(const Pose& pose) const {
        SkinnedMesh output = m_mesh;
        const auto palette = pose.palette();
        const SkinJob job{&m_mesh, palette, output.positions, output.normals};
        EXPECT_TRUE(job.validate());
        job.run();
        return output;
    }

    const SkinnedMesh m_mesh = loadMannequin(Detail::Medium);
};

TEST_F(SkinTest, LeavesTheNullPoseUnchanged) {
    const SkinnedMesh output = skinned(Pose());
    for (std::size_t i = 0; i < output.vertexCount(); ++i) {
        ASSERT_LT(glm::distance(output.positions[i], m_mesh.positions[i]), 2e-6F);
        ASSERT_LT(glm::distance(output.normals[i], m_mesh.normals[i]), 2e-6F);
    }
}

TEST_F(SkinTest, MovesTheWholeBodyRigidlyWithThePelvis) {
    Pose pose;
    pose.positions[Pelvis] = {1.0F, 2.0F, 0.5F};
    pose.local[Pelvis] = turn(200.0F, glm::normalize(glm::vec3(1.0F, 2.0F, 3.0F)));
    pose.update();
    const SkinnedMesh output = skinned(pose);
    for (std::size_t i = 0; i < output.vertexCount(); ++i) {
        const glm::vec3 expected =
            pose.local[Pelvis] * (m_mesh.positions[i] - kReferenceNullPose[Pelvis]) + pose.positions[Pelvis];
        ASSERT_LT(glm::distance(output.positions[i], expected), 5e-6F);
        ASSERT_LT(glm::distance(output.normals[i], pose.local[Pelvis] * m_mesh.normals[i]), 5e-6F);
    }
}

TEST_F(SkinTest, DoesNotDependOnTheSignsOfOrientations) {
    Pose pose = bentPose();
    const SkinnedMesh expected = skinned(pose);
    for (std::size_t i = 0; i < kSegmentCount; i += 2) {
        pose.orientations[i] = -pose.orientations[i];
    }
    const SkinnedMesh output = skinned(pose);
    for (std::size_t i = 0; i < output.vertexCount(); ++i) {
        ASSERT_LT(glm::distance(output.positions[i], expected.positions[i]), 1e-5F);
    }
}

TEST_F(SkinTest, BlendsPalettesOfAnySign) {
    auto palette = bentPose().palette();
    SkinnedMesh expected = m_mesh;
    SkinJob{&m_mesh, palette, expected.positions, expected.normals}.run();
    for (std::size_t i = 0; i < kJointCount; i += 2) {
        palette[i] = {-palette[i].real, -palette[i].dual};
    }
    SkinnedMesh output = m_mesh;
    SkinJob{&m_mesh, palette, output.positions, output.normals}.run();
    for (std::size_t i = 0; i < output.vertexCount(); ++i) {
        ASSERT_LT(glm::distance(output.positions[i], expected.positions[i]), 1e-5F);
    }
}

TEST_F(SkinTest, KeepsTheForearmThickUnderPronation) {
    // Linear blending pinches the elbow to a candy wrapper here.
    Pose pose;
    pose.local[RightForeArm] = turn(150.0F, kY);
    pose.update();
    const SkinnedMesh output = skinned(pose);
    for (std::size_t i = 0; i < output.vertexCount(); ++i) {
        const glm::vec3& rest = m_mesh.positions[i];
        if (rest.y < -0.40F && rest.y > -0.60F) {
            const auto radius = [](const glm::vec3& p) {
                return std::hypot(p.x, p.z - kReferenceNullPose[RightForeArm].z);
            };
            ASSERT_GT(radius(output.positions[i]), 0.85F * radius(rest));
        }
    }
}

TEST_F(SkinTest, RefusesWhatDoesNotFitTogether) {
    const auto palette = Pose().palette();
    SkinnedMesh output = m_mesh;
    SkinJob job{nullptr, palette, output.positions, output.normals};
    EXPECT_EQ(job.validate().error(), "there is no mesh to skin");
    job.mesh = &m_mesh;
    EXPECT_TRUE(job.validate());
    job.normals = job.normals.first(5);
    EXPECT_EQ(job.validate().error(), "the output differs in size from the mesh");
    job.normals = output.normals;
    job.palette = job.palette.first(kSegmentCount);
    EXPECT_FALSE(job.validate()) << "the mesh uses twist joints";
}

} // namespace
} // namespace posewire::render
