// SPDX-License-Identifier: MIT
#include "render/mesh/bone_mapping.h"
#include "tests/render/mesh/skeletons.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

namespace posewire::render::test {
namespace {

using Names = std::map<std::string, std::string>;

/// The bone of every segment that has one.
Names named(const BoneMapping& mapping, const std::vector<ImportedBone>& bones) {
    Names names;
    for (std::size_t i = 0; i < kMappableCount; ++i) {
        if (mapping.bones[i] >= 0) {
            names[std::string(mappableName(i))] = bones[static_cast<std::size_t>(mapping.bones[i])].name;
        }
    }
    return names;
}

void expectMapped(const Skeleton& skeleton, std::string_view naming, const Names& expected) {
    const std::vector<ImportedBone> bones = skeleton.bones();
    const BoneMapping mapping = mapBones(bones);
    ASSERT_NE(mapping.naming, nullptr) << naming;
    EXPECT_EQ(mapping.naming->title, naming);
    EXPECT_TRUE(missingSegments(mapping).empty());
    const auto check = checkMapping(mapping, bones);
    EXPECT_TRUE(check) << check.error();
    const Names found = named(mapping, bones);
    for (const auto& [segment, bone] : expected) {
        const auto place = found.find(segment);
        EXPECT_EQ(place == found.end() ? "" : place->second, bone) << segment;
    }
}

TEST(BoneMapping, KnowsMvn) {
    expectMapped(kMvnSkeleton, "MVN",
                 {{"Pelvis", "Pelvis"},
                  {"L5", "L5"},
                  {"L3", "L3"},
                  {"T12", "T12"},
                  {"T8", "T8"},
                  {"Neck", "Neck"},
                  {"Head", "Head"},
                  {"LeftShoulder", "LeftShoulder"},
                  {"RightUpperArm", "RightUpperArm"},
                  {"LeftForeArm", "LeftForeArm"},
                  {"RightToe", "RightToe"},
                  {"LeftCarpus", "LeftCarpus"},
                  {"LeftFirstMC", "LeftFirstMC"},
                  {"LeftFirstPP", "LeftFirstPP"},
                  {"LeftFirstDP", "LeftFirstDP"},
                  {"RightSecondMC", "RightSecondMC"},
                  {"RightSecondDP", "RightSecondDP"}});
}

TEST(BoneMapping, KnowsMixamo) {
    expectMapped(kMixamoSkeleton, "Mixamo",
                 {{"Pelvis", "mixamorig:Hips"},
                  {"L5", "mixamorig:Spine"},
                  {"L3", ""},
                  {"T12", "mixamorig:Spine1"},
                  {"T8", "mixamorig:Spine2"},
                  {"LeftShoulder", "mixamorig:LeftShoulder"},
                  {"LeftUpperArm", "mixamorig:LeftArm"},
                  {"LeftUpperLeg", "mixamorig:LeftUpLeg"},
                  {"LeftLowerLeg", "mixamorig:LeftLeg"},
                  {"RightToe", "mixamorig:RightToeBase"},
                  {"LeftFirstMC", "mixamorig:LeftHandThumb1"},
                  {"LeftFirstDP", "mixamorig:LeftHandThumb3"},
                  {"LeftSecondMC", ""},
                  {"LeftSecondPP", "mixamorig:LeftHandIndex1"},
                  {"RightFifthDP", "mixamorig:RightHandPinky3"}});
}

TEST(BoneMapping, KnowsUnreal) {
    expectMapped(kUnrealSkeleton, "Unreal",
                 {{"Pelvis", "pelvis"},
                  {"L5", "spine_01"},
                  {"T8", "spine_05"},
                  {"Neck", "neck_01"},
                  {"Head", "head"},
                  {"RightShoulder", "clavicle_r"},
                  {"LeftUpperArm", "upperarm_l"},
                  {"LeftForeArm", "lowerarm_l"},
                  {"LeftLowerLeg", "calf_l"},
                  {"LeftFoot", "foot_l"},
                  {"LeftToe", "ball_l"},
                  {"RightFirstPP", "thumb_02_r"},
                  {"RightSecondMC", "index_metacarpal_r"},
                  {"RightSecondPP", "index_01_r"}});
}

TEST(BoneMapping, KnowsUnityAndVrm) {
    expectMapped(kUnitySkeleton, "VRM or Unity humanoid",
                 {{"Pelvis", "Hips"},
                  {"T8", "UpperChest"},
                  {"LeftUpperArm", "leftUpperArm"},
                  {"LeftForeArm", "leftLowerArm"},
                  {"LeftFirstMC", "leftThumbProximal"},
                  {"LeftFirstPP", "leftThumbIntermediate"},
                  {"LeftFirstDP", "leftThumbDistal"},
                  {"RightSecondPP", "rightIndexProximal"},
                  {"RightSecondMP", "rightIndexIntermediate"},
                  {"RightToe", "rightToes"}});
    expectMapped(kVrmSkeleton, "VRoid Studio",
                 {{"Pelvis", "J_Bip_C_Hips"},
                  {"LeftUpperArm", "J_Bip_L_UpperArm"},
                  {"RightLowerLeg", "J_Bip_R_LowerLeg"},
                  {"RightToe", "J_Bip_R_ToeBase"},
                  {"LeftFirstMC", "J_Bip_L_Thumb1"},
                  {"LeftSecondDP", "J_Bip_L_Index3"}});
}

TEST(BoneMapping, KnowsRigifyWithItsHeadCalledSpine) {
    for (const auto& [skeleton, prefix] :
         {std::pair{kRigifySkeleton, std::string("DEF-")}, std::pair{kMetarigSkeleton, std::string()}}) {
        expectMapped(skeleton, "Blender Rigify",
                     {{"Pelvis", prefix + "spine"},
                      {"L5", prefix + "spine.001"},
                      {"T12", prefix + "spine.002"},
                      {"T8", prefix + "spine.003"},
                      {"Neck", prefix + "spine.004"},
                      {"Head", prefix + "spine.006"},
                      {"LeftUpperArm", prefix + "upper_arm.L"},
                      {"LeftForeArm", prefix + "forearm.L"},
                      {"RightUpperLeg", prefix + "thigh.R"},
                      {"RightLowerLeg", prefix + "shin.R"},
                      {"LeftToe", prefix + "toe.L"},
                      {"LeftSecondMC", prefix + "palm.01.L"},
                      {"LeftSecondPP", prefix + "f_index.01.L"},
                      {"LeftFirstMC", prefix + "thumb.01.L"}});
    }
}

TEST(BoneMapping, KnowsBiped) {
    expectMapped(kBipedSkeleton, "3ds Max Biped",
                 {{"Pelvis", "Bip01 Pelvis"},
                  {"L3", "Bip01 Spine"},
                  {"T8", "Bip01 Spine1"},
                  {"LeftShoulder", "Bip01 L Clavicle"},
                  {"RightForeArm", "Bip01 R Forearm"},
                  {"LeftToe", "Bip01 L Toe0"}});
}

TEST(BoneMapping, DoesNotMindCaseOrPrefixes) {
    for (const std::string prefix : {"Armature_", "Rig|", "model:character:", "Bip001 "}) {
        std::vector<ImportedBone> bones = kMixamoSkeleton.bones();
        for (ImportedBone& bone : bones) {
            std::ranges::transform(bone.name, bone.name.begin(),
                                   [](unsigned char c) { return std::toupper(c); });
            bone.name.replace(0, std::string("mixamorig:").size(), "");
            bone.name = prefix + (bone.name.starts_with("LEFT")    ? "Left_" + bone.name.substr(4)
                                  : bone.name.starts_with("RIGHT") ? "Right_" + bone.name.substr(5)
                                                                   : bone.name);
        }
        const BoneMapping mapping = mapBones(bones);
        EXPECT_TRUE(checkMapping(mapping, bones)) << prefix;
        EXPECT_EQ(named(mapping, bones)["LeftUpperLeg"], prefix + "Left_UPLEG");
    }
}

TEST(BoneMapping, PrefersBonesThatMoveSomething) {
    std::vector<ImportedBone> bones = kMixamoSkeleton.bones();
    ImportedBone handle = bones[0];
    handle.name = "Hips";
    handle.hasWeights = false;
    handle.parent = -1;
    bones.insert(bones.begin(), handle);
    for (std::size_t i = 1; i < bones.size(); ++i) {
        bones[i].parent = bones[i].parent < 0 ? 0 : bones[i].parent + 1;
    }
    EXPECT_EQ(mapBones(bones).bones[Pelvis], 1);
}

/// With a chain of other bones between the pelvis and the neck.
std::vector<ImportedBone> withSpine(const std::vector<std::string>& spine) {
    std::vector<ImportedBone> bones{{"mixamorig:Hips", -1, {}, {}, true}};
    for (const std::string& bone : spine) {
        bones.push_back({"mixamorig:" + bone, static_cast<int>(bones.size()) - 1, {}, {}, true});
    }
    const int chest = static_cast<int>(bones.size()) - 1;
    const std::vector<ImportedBone> whole = kMixamoSkeleton.bones();
    std::vector<int> places(whole.size(), 0);
    places[1] = places[2] = places[3] = chest;
    for (std::size_t i = 4; i < whole.size(); ++i) {
        places[i] = static_cast<int>(bones.size());
        bones.push_back(whole[i]);
        bones.back().parent = places[static_cast<std::size_t>(whole[i].parent)];
    }
    return bones;
}

TEST(BoneMapping, SpreadsSpinesOfAnyLength) {
    const std::vector<std::string> all{"Spine", "Spine1", "Spine2", "Spine3"};
    for (int count = 1; count <= 4; ++count) {
        const std::vector<ImportedBone> bones = withSpine({all.begin(), all.begin() + count});
        const BoneMapping mapping = mapBones(bones);
        EXPECT_TRUE(checkMapping(mapping, bones));
        EXPECT_EQ(mapping.bones[T8], count) << "the last carries the shoulders";
        int before = 0;
        int mapped = 0;
        for (const Segment segment : {L5, L3, T12, T8}) {
            if (mapping.bones[segment] >= 0) {
                EXPECT_GT(mapping.bones[segment], before) << count;
                before = mapping.bones[segment];
                ++mapped;
            }
        }
        EXPECT_EQ(mapped, count);
    }
}

TEST(BoneMapping, KnowsTheThumbOfBothVersionsOfVrm) {
    std::vector<ImportedBone> bones = kUnitySkeleton.bones();
    for (ImportedBone& bone : bones) {
        bone.name = bone.name == "leftThumbProximal"       ? "leftThumbMetacarpal"
                    : bone.name == "leftThumbIntermediate" ? "leftThumbProximal"
                                                           : bone.name;
    }
    Names found = named(mapBones(bones), bones);
    EXPECT_EQ(found["LeftFirstMC"], "leftThumbMetacarpal");
    EXPECT_EQ(found["LeftFirstPP"], "leftThumbProximal");
    EXPECT_EQ(found["LeftFirstDP"], "leftThumbDistal");
    EXPECT_EQ(found["RightFirstMC"], "rightThumbProximal");
}

TEST(BoneMapping, TakesTheBonesOfTheOperator) {
    const std::vector<ImportedBone> bones = kMvnSkeleton.bones();
    BoneMapping mapping = mapBones(bones);
    const int head = mapping.bones[Head];
    const std::vector<BoneCorrection> wanted{{Neck, "Head"}, {L5, ""}, {T8, "Antenna"}};
    const std::vector<BoneCorrection> unfit = correct(mapping, bones, wanted);
    EXPECT_EQ(unfit, std::vector<BoneCorrection>{wanted[2]});
    EXPECT_EQ(mapping.bones[Neck], head);
    EXPECT_EQ(mapping.foundBy[Neck], FoundBy::Operator);
    EXPECT_EQ(mapping.bones[Head], -1); // a bone follows one segment
    EXPECT_EQ(mapping.bones[L5], -1);
    EXPECT_EQ(mapping.bones[T8], mapBones(bones).bones[T8]);
}

TEST(BoneMapping, SaysWhatIsMissing) {
    std::vector<ImportedBone> bones = kMixamoSkeleton.bones();
    for (ImportedBone& bone : bones) {
        bone.name = bone.name == "mixamorig:LeftForeArm" ? "claw" : bone.name;
    }
    const BoneMapping mapping = mapBones(bones);
    EXPECT_EQ(missingSegments(mapping), std::vector<std::size_t>{LeftForeArm});
    EXPECT_EQ(checkMapping(mapping, bones).error(),
              "no bone for Left Forearm (LeftForeArm), as Mixamo names them");
}

TEST(BoneMapping, SaysWhichNamesAreKnownIfItKnowsNone) {
    std::vector<ImportedBone> bones = kMixamoSkeleton.bones();
    for (std::size_t i = 0; i < bones.size(); ++i) {
        bones[i].name = "bone " + std::to_string(i);
    }
    const BoneMapping mapping = mapBones(bones);
    EXPECT_EQ(mapping, BoneMapping());
    EXPECT_EQ(missingSegments(mapping).size(), 14U);
    const std::string error = checkMapping(mapping, bones).error();
    EXPECT_TRUE(error.starts_with("no bone for Pelvis, Head, ")) << error;
    EXPECT_TRUE(error.ends_with("; known are the bone names of " + knownNamings())) << error;
    EXPECT_NE(error.find("Mixamo"), std::string::npos);
}

TEST(BoneMapping, RefusesLimbsThatDoNotHangTogether) {
    const std::vector<ImportedBone> bones = kMvnSkeleton.bones();
    BoneMapping crossed = mapBones(bones);
    std::swap(crossed.bones[LeftForeArm], crossed.bones[RightForeArm]);
    EXPECT_NE(checkMapping(crossed, bones).error().find("does not hang on"), std::string::npos);
}

} // namespace
} // namespace posewire::render::test
