// SPDX-License-Identifier: MIT
#include "render/mesh/mannequin.h"
#include "render/mesh/null_pose_fit.h"
#include "tests/render/mesh/normals.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

NullPose scaled(float factor) {
    NullPose pose = kReferenceNullPose;
    for (glm::vec3& origin : pose) {
        origin *= factor;
    }
    return pose;
}

struct Extent {
    glm::vec3 low{1e9F};
    glm::vec3 high{-1e9F};
};

Extent extentOf(const SkinnedMesh& mesh) {
    Extent extent;
    for (const glm::vec3& position : mesh.positions) {
        extent.low = glm::min(extent.low, position);
        extent.high = glm::max(extent.high, position);
    }
    return extent;
}

float heightOf(const SkinnedMesh& mesh) {
    return extentOf(mesh).high.z - extentOf(mesh).low.z;
}

class NullPoseFitTest : public testing::Test {
protected:
    SkinnedMesh fit(const NullPose& performer, const FingerOrigins& fingers = unknownFingers()) {
        const BodyFit body = fitBody(performer, fingers);
        m_origins = body.origins;
        m_fingers = body.fingerOrigins;
        return fitted(m_template, body);
    }

    const SkinnedMesh m_template = loadMannequin(Detail::Medium);
    NullPose m_origins{};
    FingerOrigins m_fingers{};
};

TEST_F(NullPoseFitTest, LeavesTheMeshUnchangedForTheReference) {
    const SkinnedMesh fitted = fit(kReferenceNullPose);
    for (std::size_t i = 0; i < fitted.vertexCount(); ++i) {
        ASSERT_LT(glm::distance(fitted.positions[i], m_template.positions[i]), 2e-6F);
        ASSERT_LT(glm::distance(fitted.normals[i], m_template.normals[i]), 2e-6F);
    }
    EXPECT_EQ(fitted.indices, m_template.indices);
}

TEST_F(NullPoseFitTest, FitsFingersToTheHandWhereNoneAreSent) {
    const float factor = 1.2F;
    static_cast<void>(fit(scaled(factor)));
    for (std::size_t i = 0; i < kFingerJointCount; ++i) {
        EXPECT_LT(glm::distance(m_fingers[i], factor * jointOrigin(kFirstFingerJoint + i)), 1e-4F);
    }
    EXPECT_EQ(fittedFingers(m_origins), m_fingers);
}

TEST_F(NullPoseFitTest, FitsFingersToTheirSegmentsInTheScaleMessage) {
    FingerOrigins fingers;
    for (std::size_t i = 0; i < kFingerJointCount; ++i) {
        const std::size_t joint = kFirstFingerJoint + i;
        const glm::vec3& hand = kReferenceNullPose[jointSegment(joint)];
        fingers[i] = hand + 1.25F * (jointOrigin(joint) - hand);
    }
    const SkinnedMesh fitted = fit(kReferenceNullPose, fingers);
    EXPECT_EQ(m_fingers, fingers);
    // A quarter longer from the wrist to the last joint of the middle finger, which is 162 mm; the rest of
    // the body stays.
    EXPECT_NEAR(extentOf(fitted).high.y - extentOf(m_template).high.y, 0.25F * 0.162F, 0.004F);
    EXPECT_NEAR(heightOf(fitted), heightOf(m_template), 1e-6F);
}

TEST_F(NullPoseFitTest, IgnoresFingersThatAreFarFromTheirHand) {
    FingerOrigins fingers;
    fingers.fill(glm::vec3(0.0F, 0.0F, 1.0F));
    fingers[7] = glm::vec3(0.0F, 50.0F, 1.4F);
    fingers[8].x = kNan;
    const SkinnedMesh fitted = fit(kReferenceNullPose, fingers);
    EXPECT_TRUE(fitted.validate(kJointCount));
    for (std::size_t i = 0; i < kFingerJointCount; ++i) {
        EXPECT_LT(glm::distance(m_fingers[i], jointOrigin(kFirstFingerJoint + i)), 1e-6F);
    }
}

TEST_F(NullPoseFitTest, ScalesAdultsEvenly) {
    const float factor = 1.95F / kReferenceStature;
    const SkinnedMesh fitted = fit(scaled(factor));
    for (std::size_t i = 0; i < fitted.vertexCount(); ++i) {
        ASSERT_LT(glm::distance(fitted.positions[i], factor * m_template.positions[i]), 1e-5F);
    }
}

TEST_F(NullPoseFitTest, KeepsTheSoleBelowTheOriginOfTheToes) {
    // Recorded null poses have the ball of the foot at z = 0 and the sole below.
    NullPose performer = kReferenceNullPose;
    for (glm::vec3& origin : performer) {
        origin.z -= 0.015F;
    }
    const Extent extent = extentOf(fit(performer));
    EXPECT_NEAR(extent.low.z, extentOf(m_template).low.z - 0.015F, 1e-5F);
    EXPECT_NEAR(extent.high.z, extentOf(m_template).high.z - 0.015F, 1e-5F);
}

TEST_F(NullPoseFitTest, MakesChildrenStouterThanSmallAdults) {
    const float factor = 1.18F / kReferenceStature;
    const SkinnedMesh fitted = fit(scaled(factor));
    EXPECT_NEAR(heightOf(fitted), 1.18F, 0.03F);
    const float depth = extentOf(fitted).high.x - extentOf(fitted).low.x;
    const float referenceDepth = extentOf(m_template).high.x - extentOf(m_template).low.x;
    EXPECT_GT(depth / referenceDepth, factor + 0.01F);
}

TEST_F(NullPoseFitTest, LengthensOneLegOnly) {
    NullPose performer = kReferenceNullPose;
    for (const Segment segment : {LeftLowerLeg, LeftFoot, LeftToe}) {
        performer[segment].z -= 0.02F;
    }
    const SkinnedMesh fitted = fit(performer);
    for (std::size_t i = 0; i < fitted.vertexCount(); ++i) {
        const glm::vec3& was = m_template.positions[i];
        if (was.y > 0.02F && was.z < 0.05F) {
            ASSERT_NEAR(fitted.positions[i].z, was.z - 0.02F, 0.004F);
        } else if (was.y < -0.02F && was.z < 0.8F) {
            ASSERT_LT(std::abs(fitted.positions[i].z - was.z), 0.007F);
        }
    }
}

TEST_F(NullPoseFitTest, ReachesTheWristsOfLongArms) {
    NullPose performer = kReferenceNullPose;
    for (const auto& [segment, shift] :
         {std::pair{LeftForeArm, 0.02F}, {LeftHand, 0.05F}, {RightForeArm, -0.02F}, {RightHand, -0.05F}}) {
        performer[segment].y += shift;
    }
    const Extent extent = extentOf(fit(performer));
    EXPECT_NEAR(extent.high.y, extentOf(m_template).high.y + 0.05F, 1e-3F);
    EXPECT_NEAR(extent.low.y, extentOf(m_template).low.y - 0.05F, 1e-3F);
}

TEST_F(NullPoseFitTest, SpreadsALongerForearmOverTheBone) {
    NullPose performer = kReferenceNullPose;
    performer[LeftHand].y += 0.047F;
    performer[RightHand].y -= 0.047F;
    const SkinnedMesh fitted = fit(performer);
    for (std::size_t i = 0; i < fitted.vertexCount(); ++i) {
        const float y = std::abs(m_template.positions[i].y);
        if (y > 0.51F && y < 0.65F) {
            const float expected = 0.450F + (y - 0.450F) * 1.2F;
            ASSERT_NEAR(std::abs(fitted.positions[i].y), expected, 1e-4F);
        }
    }
}

TEST_F(NullPoseFitTest, KeepsUnitNormals) {
    const SkinnedMesh fitted = fit(scaled(0.8F));
    std::vector<glm::vec3> byArea(fitted.vertexCount());
    computeNormals(fitted.positions, fitted.indices, byArea);
    for (std::size_t i = 0; i < fitted.vertexCount(); ++i) {
        ASSERT_NEAR(glm::length(fitted.normals[i]), 1.0F, 1e-5F);
        ASSERT_GT(glm::dot(fitted.normals[i], byArea[i]), 0.0F);
    }
}

TEST_F(NullPoseFitTest, ReplacesASegmentWithoutPlace) {
    NullPose performer = kReferenceNullPose;
    performer[LeftForeArm] = glm::vec3(kNan);
    const SkinnedMesh fitted = fit(performer);
    ASSERT_TRUE(fitted.validate(kJointCount));
    EXPECT_LT(glm::distance(m_origins[LeftForeArm], kReferenceNullPose[LeftForeArm]), 1e-5F);
    EXPECT_LT(glm::distance(m_origins[LeftHand], kReferenceNullPose[LeftHand]), 1e-5F);
    EXPECT_NEAR(heightOf(fitted), heightOf(m_template), 1e-4F);
}

TEST_F(NullPoseFitTest, FallsBackToTheReferenceWhenAllOriginsAreZero) {
    const SkinnedMesh fitted = fit(NullPose{});
    ASSERT_TRUE(fitted.validate(kJointCount));
    EXPECT_NEAR(heightOf(fitted), heightOf(m_template), 1e-4F);
}

TEST_F(NullPoseFitTest, StaysFiniteAndHumanForNonsense) {
    for (const float bad : {kNan, std::numeric_limits<float>::infinity(), 1e30F, -1e6F, 0.0F}) {
        for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
            NullPose performer = kReferenceNullPose;
            performer[segment] = glm::vec3(bad);
            const SkinnedMesh fitted = fit(performer);
            ASSERT_TRUE(fitted.validate(kJointCount)) << kJointNames[segment] << ' ' << bad;
            ASSERT_GT(heightOf(fitted), 0.8F);
            ASSERT_LT(heightOf(fitted), 4.0F);
        }
    }
}

TEST_F(NullPoseFitTest, FitsAPelvisAtTheOrigin) {
    NullPose performer = kReferenceNullPose;
    for (glm::vec3& origin : performer) {
        origin.z -= kReferenceNullPose[Pelvis].z;
    }
    EXPECT_NEAR(heightOf(fit(performer)), heightOf(m_template), 1e-4F);
}

TEST_F(NullPoseFitTest, TakesTheStatureFromTheTrunkWhereTheFeetAreUnknown) {
    NullPose performer = scaled(1.1F);
    performer[LeftFoot] = performer[RightFoot] = glm::vec3(kNan);
    const SkinnedMesh fitted = fit(performer);
    ASSERT_TRUE(fitted.validate(kJointCount));
    EXPECT_NEAR(heightOf(fitted), 1.1F * heightOf(m_template), 0.01F);
}

TEST_F(NullPoseFitTest, PutsAPelvisThatIsFarAwayAtTheReference) {
    NullPose performer = kReferenceNullPose;
    performer[Pelvis] = {0.0F, 0.0F, 500.0F};
    fit(performer);
    EXPECT_EQ(m_origins[Pelvis], kReferenceNullPose[Pelvis]);
}

} // namespace
} // namespace posewire::render
