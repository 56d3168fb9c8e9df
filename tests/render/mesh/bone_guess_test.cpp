// SPDX-License-Identifier: MIT
#include "render/mesh/bone_mapping.h"
#include "tests/render/mesh/skeletons.h"

#include <map>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render::test {
namespace {

using Expected = std::map<std::size_t, std::string>;

void expectWords(const Skeleton& skeleton, const Expected& expected) {
    const std::vector<ImportedBone> bones = skeleton.bones();
    const BoneMapping mapping = mapBones(bones);
    const auto check = checkMapping(mapping, bones);
    ASSERT_TRUE(check) << check.error();
    for (const auto& [segment, bone] : expected) {
        ASSERT_GE(mapping.bones[segment], 0) << mappableTitle(segment);
        EXPECT_EQ(bones[static_cast<std::size_t>(mapping.bones[segment])].name, bone)
            << mappableTitle(segment);
        EXPECT_NE(mapping.foundBy[segment], FoundBy::Shape) << mappableTitle(segment);
    }
}

TEST(BoneGuess, KnowsAnatomicalWordsWithASuffix) {
    expectWords(kAnatomicalSkeleton, {{Pelvis, "pelvis_bind"},
                                      {Neck, "cervical_bind"},
                                      {Head, "skull_bind"},
                                      {T8, "spineHigh_bind"},
                                      {LeftShoulder, "clavicle_lf_bind"},
                                      {LeftUpperArm, "humerus_lf_bind"},
                                      {RightForeArm, "ulna_rt_bind"},
                                      {RightHand, "wrist_rt_bind"},
                                      {RightUpperLeg, "femur_rt_bind"},
                                      {LeftLowerLeg, "tibia_lf_bind"},
                                      {LeftFoot, "ankle_lf_bind"},
                                      {LeftToe, "ball_lf_bind"},
                                      {kSegmentCount + 17, "pinky_lf_01_bind"}});
}

TEST(BoneGuess, KnowsPrefixesThatAllBonesShare) {
    expectWords(kPrefixedSkeleton, {{Pelvis, "hero_newSkeleton_hips"},
                                    {LeftUpperArm, "hero_newSkeleton_L_shoulder"},
                                    {RightHand, "hero_newSkeleton_R_wrist"},
                                    {LeftUpperLeg, "hero_newSkeleton_L_hip"},
                                    {T8, "hero_newSkeleton_chest01"}});
}

TEST(BoneGuess, KnowsSidesInAnyLetterCase) {
    expectWords(kGluedSkeleton,
                {{Pelvis, "hip"}, {LeftHand, "Lefthand"}, {RightHand, "righthand"}, {LeftFoot, "Leftfoot"}});
}

TEST(BoneGuess, KnowsDazAndNamesOfJoints) {
    expectWords(kDazSkeleton, {{Pelvis, "pelvis"},
                               {LeftUpperArm, "lShldrBend"},
                               {LeftForeArm, "lForearmBend"},
                               {RightUpperLeg, "rThighBend"},
                               {kSegmentCount + 1, "lThumb1"},
                               {RightToe, "rToe"}});
    expectWords(kJointSkeleton,
                {{LeftShoulder, "LeftCollar"}, {LeftUpperArm, "LeftShoulder"}, {RightUpperLeg, "RightHip"}});
}

TEST(BoneGuess, FindsNamelessBonesByTheirShape) {
    const glm::quat none(1.0F, 0.0F, 0.0F, 0.0F);
    const glm::quat aside = glm::angleAxis(glm::radians(90.0F), glm::vec3(0.0F, 0.0F, 1.0F));
    const glm::quat lying = glm::angleAxis(glm::radians(90.0F), glm::vec3(0.0F, 1.0F, 0.0F));
    const glm::quat upsideDown = glm::angleAxis(glm::radians(180.0F), glm::vec3(1.0F, 0.0F, 0.0F));
    for (const glm::quat& turn : {none, aside, aside * aside, lying, upsideDown}) {
        for (const float armsDown : {0.0F, 45.0F, 75.0F}) {
            const std::vector<ImportedBone> bones = namelessBones(turn, armsDown);
            const BoneMapping mapping = mapBones(bones);
            EXPECT_EQ(mapping.naming, nullptr);
            for (std::size_t i = 0; i < kSegmentCount; ++i) {
                EXPECT_EQ(mapping.bones[i], static_cast<int>(i)) << mappableTitle(i) << ", arms " << armsDown;
                EXPECT_EQ(mapping.foundBy[i], FoundBy::Shape);
            }
        }
    }
}

TEST(BoneGuess, FillsWhatNamesLeaveOpenByShape) {
    std::vector<ImportedBone> bones = namelessBones();
    for (std::size_t i = 0; i < bones.size(); ++i) {
        bones[i].name = i == LeftForeArm || i == RightLowerLeg ? bones[i].name : std::string(mappableName(i));
    }
    const BoneMapping mapping = mapBones(bones);
    EXPECT_EQ(mapping.bones[LeftForeArm], static_cast<int>(LeftForeArm));
    EXPECT_EQ(mapping.foundBy[LeftForeArm], FoundBy::Shape);
    EXPECT_EQ(mapping.foundBy[RightForeArm], FoundBy::Naming);
}

TEST(BoneGuess, SeesNoPersonInATail) {
    std::vector<ImportedBone> bones;
    for (int i = 0; i < 20; ++i) {
        bones.push_back(
            {"joint" + std::to_string(i), i - 1, {0.0F, 0.0F, 0.1F * static_cast<float>(i)}, {}, true});
    }
    EXPECT_EQ(mapBones(bones), BoneMapping());
}

} // namespace
} // namespace posewire::render::test
