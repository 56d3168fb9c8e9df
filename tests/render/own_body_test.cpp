// SPDX-License-Identifier: MIT
#include "render/mesh/import.h"
#include "render/mesh/own_body.h"
#include "tests/render/poses.h"
#include "tests/render/rig.h"
#include "tests/support/paths.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render::test {
namespace {

OwnBody bodyOf(const Rig& rig, const RestChoice& choice = {}) {
    const ImportedCharacter character = rig.character();
    auto body = makeOwnBody(character, mapBones(character.bones), choice);
    EXPECT_TRUE(body) << body.error();
    return body.value_or(OwnBody{});
}

std::vector<DualQuaternion> ownPalette(const OwnBody& body, const Pose& pose, float scale = 1.0F,
                                       const NullPose& origins = kReferenceNullPose) {
    const std::vector<DualQuaternion> mannequin = paletteOf(pose, origins);
    std::vector<DualQuaternion> palette(body.joints.size());
    const OwnPaletteJob job{&body, scale, mannequin, origins, palette};
    EXPECT_TRUE(job.validate());
    job.run();
    return palette;
}

float degreesBetween(const glm::vec3& a, const glm::vec3& b) {
    return glm::degrees(std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0F, 1.0F)));
}

/// Bones that have the direction of their segment.
constexpr std::array kLimbs{LeftUpperArm, LeftForeArm,  RightUpperArm, RightForeArm,
                            LeftUpperLeg, LeftLowerLeg, RightUpperLeg, RightLowerLeg};

float worstLimb(const OwnBody& body, const Pose& pose, std::span<const DualQuaternion> palette) {
    float worst = 0.0F;
    for (const Segment segment : kLimbs) {
        const auto next = static_cast<Segment>(segment + 1);
        worst = std::max(worst, degreesBetween(placeOf(body, palette, next) - placeOf(body, palette, segment),
                                               pose.positions[next] - pose.positions[segment]));
    }
    return worst;
}

/// The lowest vertex.
float lowest(const OwnBody& body, std::span<const DualQuaternion> palette) {
    SkinnedMesh skinned = body.mesh;
    const SkinJob job{&body.mesh, palette, skinned.positions, skinned.normals};
    job.run();
    float z = 1e9F;
    for (const glm::vec3& position : skinned.positions) {
        z = std::min(z, position.z);
    }
    return z;
}

const std::array kPoses{&tPose,     &standingPose,   &lungePose,     &squatPose,
                        &elbowPose, &raisedArmsPose, &spreadLegsPose};

TEST(OwnBody, StandsInTheTPoseWhateverItsRestPose) {
    for (const Rig& rig :
         {Rig{}, Rig{.armsDown = 0.0F, .legsApart = 0.0F, .feetOut = 0.0F, .palmsAhead = 0.0F},
          Rig{.armsDown = 80.0F, .legsApart = -3.0F, .feetOut = 35.0F, .palmsAhead = 90.0F}}) {
        const OwnBody body = bodyOf(rig);
        const auto joint = [&](Segment segment) {
            return body.joints[static_cast<std::size_t>(body.segmentJoints[segment])].origin;
        };
        for (const Segment segment : kLimbs) {
            const auto next = static_cast<Segment>(segment + 1);
            EXPECT_LT(degreesBetween(joint(next) - joint(segment),
                                     kReferenceNullPose[next] - kReferenceNullPose[segment]),
                      0.05F)
                << kJointNames[segment];
        }
        const glm::vec3 foot = joint(LeftToe) - joint(LeftFoot);
        EXPECT_NEAR(foot.y, 0.0F, 1e-4F) << "feet point ahead";
        EXPECT_NEAR(foot.z, -0.045F, 1e-4F) << "and stand as flat as they did";
        float floor = 1.0F;
        for (const glm::vec3& position : body.mesh.positions) {
            floor = std::min(floor, position.z);
        }
        EXPECT_NEAR(floor, 0.0F, 1e-5F);
        EXPECT_NEAR(body.hips.x, 0.0F, 1e-5F);
        EXPECT_NEAR(body.hips.y, 0.0F, 1e-5F);
    }
}

TEST(OwnBody, FollowsPosesWithItsOwnBonesWithinHalfADegree) {
    const OwnBody body = bodyOf({});
    for (const auto& make : kPoses) {
        const Pose pose = placed(make(), {1.2F, -0.7F, 0.0F}, 0.8F);
        EXPECT_LT(worstLimb(body, pose, ownPalette(body, pose)), 0.5F);
    }
}

/// Bones beside those of limbs, which spread their twist and swing, go with them.
TEST(OwnBody, OfTheMannequinsOwnFileIsTheMannequin) {
    const auto character =
        importCharacter(posewire::test::sourcePath("resources/mannequin_low.glb").string());
    ASSERT_TRUE(character) << character.error();
    const auto body = makeOwnBody(*character, mapBones(character->bones), {});
    ASSERT_TRUE(body) << body.error();
    for (const auto& make : kPoses) {
        const Pose pose = placed(make(), {0.4F, 0.2F, 0.0F}, -0.6F);
        SkinnedMesh own = body->mesh;
        const auto palette = ownPalette(*body, pose);
        const SkinJob ownJob{&body->mesh, palette, own.positions, own.normals};
        ownJob.run();
        SkinnedMesh mannequin = character->mesh;
        const auto joints = paletteOf(pose, kReferenceNullPose);
        std::vector<DualQuaternion> byBone(character->bones.size());
        for (std::size_t i = 0; i < byBone.size(); ++i) {
            const auto joint = std::ranges::find(kJointNames, character->bones[i].name);
            ASSERT_NE(joint, kJointNames.end()) << character->bones[i].name;
            byBone[i] = joints[static_cast<std::size_t>(joint - kJointNames.begin())];
        }
        const SkinJob job{&character->mesh, byBone, mannequin.positions, mannequin.normals};
        job.run();
        float worst = 0.0F;
        for (std::size_t i = 0; i < own.vertexCount(); ++i) {
            worst = std::max(worst, glm::distance(own.positions[i], mannequin.positions[i]));
        }
        EXPECT_LT(worst, 0.02F) << "metres";
    }
}

TEST(OwnBody, KeepsTheLengthsOfTheFile) {
    const OwnBody body = bodyOf({});
    for (const auto& make : kPoses) {
        const auto palette = ownPalette(body, make());
        EXPECT_NEAR(glm::distance(placeOf(body, palette, LeftUpperArm), placeOf(body, palette, LeftForeArm)),
                    0.27F, 1e-4F);
        EXPECT_NEAR(glm::distance(placeOf(body, palette, RightLowerLeg), placeOf(body, palette, RightFoot)),
                    0.42F, 1e-4F);
    }
}

TEST(OwnBody, IsTheSameForEveryUnitUpAxisAndHeadingOfTheFile) {
    const OwnBody plain = bodyOf({});
    const auto turn = [](float degrees, const glm::vec3& axis) {
        return glm::angleAxis(glm::radians(degrees), axis);
    };
    for (const glm::quat& fileTurn : {turn(90, {0, 0, 1}), turn(180, {0, 0, 1}), turn(90, {1, 0, 0}),
                                      turn(-90, {1, 0, 0}), turn(90, {0, 1, 0}) * turn(-90, {1, 0, 0})}) {
        for (const float unit : {1.0F, 100.0F, 10.0F, 1'000.0F, 0.01F}) {
            const OwnBody body = bodyOf({.fileTurn = fileTurn, .fileUnit = unit});
            ASSERT_EQ(body.mesh.vertexCount(), plain.mesh.vertexCount());
            for (std::size_t i = 0; i < body.mesh.vertexCount(); ++i) {
                ASSERT_LT(glm::distance(body.mesh.positions[i], plain.mesh.positions[i]), 3e-3F) << unit;
            }
        }
    }
}

TEST(OwnBody, ReadsTheRestPose) {
    const RestReading reading = bodyOf({.fileUnit = 100.0F}).reading;
    EXPECT_FLOAT_EQ(reading.unit, 0.01F);
    EXPECT_NEAR(reading.armsBelowLevel, 45.0F, 0.1F);
    EXPECT_NEAR(reading.height, 1.78F, 0.04F);
    EXPECT_TRUE(reading.isInOtherUnit);
    EXPECT_FALSE(bodyOf({}).reading.isInOtherUnit);
    EXPECT_FLOAT_EQ(bodyOf({.fileUnit = 100.0F}, {.unit = 0.001F}).reading.unit, 0.001F)
        << "as it was chosen";
    EXPECT_NEAR(bodyOf({.fileUnit = 100.0F}, {.unit = 0.001F}).reading.height, 0.178F, 0.004F);
}

TEST(OwnBody, SaysThatTheFeetPointBackwards) {
    ImportedCharacter character = Rig{}.character();
    BoneMapping mapping = mapBones(character.bones);
    for (std::size_t left = LeftShoulder; left <= LeftHand; ++left) {
        std::swap(mapping.bones[left], mapping.bones[left - LeftShoulder + RightShoulder]);
    }
    for (std::size_t left = LeftUpperLeg; left <= LeftToe; ++left) {
        std::swap(mapping.bones[left], mapping.bones[left - LeftUpperLeg + RightUpperLeg]);
    }
    const auto body = makeOwnBody(character, mapping, {});
    ASSERT_TRUE(body);
    EXPECT_TRUE(body->reading.pointsBackwards);
}

TEST(OwnBody, TurnsByQuarters) {
    const OwnBody plain = bodyOf({.armsDown = 0.0F}, {.isStraightened = false});
    const OwnBody turned = bodyOf({.armsDown = 0.0F}, {.quarterTurns = 1, .isStraightened = false});
    for (std::size_t i = 0; i < plain.mesh.vertexCount(); ++i) {
        const glm::vec3& at = plain.mesh.positions[i];
        ASSERT_LT(glm::distance(turned.mesh.positions[i], glm::vec3(-at.y, at.x, at.z)), 1e-4F);
    }
}

TEST(OwnBody, LeavesARestPoseAsItIsWhereThatIsAsked) {
    const OwnBody body = bodyOf({}, {.isStraightened = false});
    const auto& upper = body.joints[static_cast<std::size_t>(body.segmentJoints[LeftUpperArm])];
    const auto& fore = body.joints[static_cast<std::size_t>(body.segmentJoints[LeftForeArm])];
    EXPECT_NEAR(degreesBetween(fore.origin - upper.origin, {0, 1, 0}), 45.0F, 0.1F);
}

TEST(OwnBody, TurnsPalmsDownAndStraightensFingers) {
    const ImportedCharacter character = Rig{}.character();
    const BoneMapping mapping = mapBones(character.bones);
    const OwnBody body = bodyOf({});
    const auto joint = [&](std::size_t mappable) {
        return body.joints[static_cast<std::size_t>(mapping.bones[mappable])].origin;
    };
    constexpr std::size_t kIndex = kSegmentCount + 5;
    constexpr std::size_t kLittle = kSegmentCount + 17;
    const glm::vec3 across = joint(kIndex) - joint(kLittle);
    EXPECT_GT(across.x, 0.05F) << "the index finger is ahead";
    EXPECT_LT(std::abs(across.z), 0.01F) << "the palm is level";
    const glm::vec3 finger = joint(kIndex + 2) - joint(kIndex);
    EXPECT_LT(
        degreesBetween(finger, jointOrigin(mappableJoint(kIndex + 2)) - jointOrigin(mappableJoint(kIndex))),
        2.0F);
}

TEST(OwnBody, PutsTheLowerFootWhereThePerformersIs) {
    for (const float legs : {0.7F, 1.0F, 1.2F}) {
        const OwnBody body = bodyOf({.legs = legs});
        for (const auto& make : {&tPose, &standingPose, &lungePose, &squatPose, &elbowPose}) {
            Pose pose = make();
            // On the floor by the soles of the mannequin.
            const std::vector<DualQuaternion> mannequin = paletteOf(pose);
            float sole = 1.0F;
            for (const Segment foot : {LeftFoot, RightFoot}) {
                for (const float ahead : {-0.055F, 0.03F}) {
                    sole = std::min(
                        sole, transformPoint(mannequin[foot], {ahead, kReferenceNullPose[foot].y, 0.0F}).z);
                }
                const auto toe = static_cast<Segment>(foot + 1);
                for (const float ahead : {0.148F, 0.213F}) {
                    sole = std::min(
                        sole, transformPoint(mannequin[toe], {ahead, kReferenceNullPose[toe].y, 0.0F}).z);
                }
            }
            pose = placed(pose, {0.0F, 0.0F, 0.3F - sole});
            EXPECT_NEAR(lowest(body, ownPalette(body, pose)), 0.3F, 0.012F) << legs;
        }
    }
}

TEST(OwnBody, IsAsLargeAsThePerformer) {
    const OwnBody body = bodyOf({});
    NullPose child = kReferenceNullPose;
    for (glm::vec3& origin : child) {
        origin *= 0.68F;
    }
    EXPECT_NEAR(scaleFor(body, child) / scaleFor(body, kReferenceNullPose), 0.68F, 0.01F);
    const float scale = scaleFor(body, child);
    const auto palette = ownPalette(body, poseFrom({}, child), scale, child);
    EXPECT_NEAR(placeOf(body, palette, Head, scale).z, child[Head].z, 0.012F);
    NullPose broken = kReferenceNullPose;
    broken[Head].z = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(scaleFor(body, broken), 1.0F);
}

TEST(OwnBody, SpreadsTheBendOfTheBackOverItsSpine) {
    const OwnBody body = bodyOf({});
    const glm::quat bend = glm::angleAxis(glm::radians(15.0F), glm::vec3(0, 1, 0));
    const Pose pose = poseFrom({{L5, bend}, {L3, bend}, {T12, bend}, {T8, bend}});
    const auto palette = ownPalette(body, pose);
    const auto angleOf = [&](int joint) {
        return glm::degrees(
            2.0F * std::acos(std::min(std::abs(palette[static_cast<std::size_t>(joint)].real.w), 1.0F)));
    };
    EXPECT_NEAR(angleOf(body.segmentJoints[L5]), 15.0F, 0.1F);
    EXPECT_NEAR(angleOf(body.segmentJoints[T12]), 45.0F, 0.1F);
    EXPECT_NEAR(angleOf(body.segmentJoints[T8]), 60.0F, 0.1F);
}

TEST(OwnBody, SharesOutUnnamedBonesOfTheTrunkAndFixesOthersToTheirParent) {
    ImportedCharacter character = Rig{}.character();
    BoneMapping mapping = mapBones(character.bones);
    const auto spine1 = static_cast<std::size_t>(mapping.bones[T12]);
    mapping.bones[T12] = -1;
    const auto body = makeOwnBody(character, mapping, {});
    ASSERT_TRUE(body);
    const OwnJoint& between = body->joints[spine1];
    EXPECT_EQ(between.from, L5);
    EXPECT_EQ(between.to, T8);
    EXPECT_FLOAT_EQ(between.share, 0.5F);
    const auto crown = static_cast<std::size_t>(
        std::ranges::find(character.bones, "mixamorig:HeadTop_End", &ImportedBone::name) -
        character.bones.begin());
    EXPECT_EQ(body->joints[crown].from, -1);
    EXPECT_EQ(body->jointSegments[crown], Head);
    const Pose pose = nodPose();
    const auto palette = ownPalette(*body, pose);
    EXPECT_EQ(palette[crown].real, palette[static_cast<std::size_t>(body->joints[crown].parent)].real);
}

TEST(OwnBody, RefusesWhatHasNoSides) {
    ImportedCharacter flat = Rig{}.character();
    for (ImportedBone& bone : flat.bones) {
        bone.position = {0.0F, 0.0F, 1.0F};
    }
    const auto body = makeOwnBody(flat, mapBones(flat.bones), {});
    ASSERT_FALSE(body);
    EXPECT_NE(body.error().find("where up and left are"), std::string::npos);
    EXPECT_FALSE(makeOwnBody(flat, {}, {}));
}

TEST(OwnBody, RefusesPalettesOfAnotherSize) {
    const OwnBody body = bodyOf({});
    std::vector<DualQuaternion> mannequin(kJointCount);
    std::vector<DualQuaternion> palette(body.joints.size());
    OwnPaletteJob job{&body, 1.0F, mannequin, kReferenceNullPose, palette};
    EXPECT_TRUE(job.validate());
    job.palette = job.palette.first(3);
    EXPECT_FALSE(job.validate());
    job = {&body, 0.0F, mannequin, kReferenceNullPose, palette};
    EXPECT_FALSE(job.validate());
}

} // namespace
} // namespace posewire::render::test
