// SPDX-License-Identifier: MIT
#include "tests/render/mesh/skeletons.h"

#include "render/mesh/joints.h"

#include <sstream>

namespace posewire::render::test {
namespace {

std::string replaced(const std::string& line, std::string_view side) {
    std::string text = line;
    for (std::size_t at = text.find('$'); at != std::string::npos; at = text.find('$', at + side.size())) {
        text.replace(at, 1, side);
    }
    return text;
}

void add(const std::vector<std::string>& lines, std::vector<int>& path, std::vector<ImportedBone>& bones) {
    for (const std::string& line : lines) {
        const std::size_t depth = line.find_first_not_of(' ');
        path.resize(depth + 1, -1);
        path[depth] = static_cast<int>(bones.size());
        bones.push_back({line.substr(depth), depth == 0 ? -1 : path[depth - 1], {}, {}, true});
    }
}

} // namespace

std::vector<ImportedBone> bonesOf(std::string_view tree, std::string_view left, std::string_view right) {
    std::vector<std::string> middle;
    std::vector<std::string> sided;
    std::istringstream stream{std::string(tree)};
    std::vector<ImportedBone> bones;
    std::vector<int> path;
    const auto flush = [&] {
        for (const std::string_view side : {left, right}) {
            std::vector<std::string> branch;
            for (const std::string& line : sided) {
                branch.push_back(replaced(line, side));
            }
            add(branch, path, bones);
        }
        sided.clear();
    };
    for (std::string line; std::getline(stream, line);) {
        if (line.find('$') == std::string::npos) {
            flush();
            add({line}, path, bones);
        } else {
            if (!sided.empty() && line.find_first_not_of(' ') <= sided.front().find_first_not_of(' ')) {
                flush();
            }
            sided.push_back(line);
        }
    }
    flush();
    return bones;
}

const Skeleton kMvnSkeleton{R"(Pelvis
 L5
  L3
   T12
    T8
     Neck
      Head
     $Shoulder
      $UpperArm
       $UpperArmTwist
       $ForeArm
        $Hand
         $Carpus
          $FirstMC
           $FirstPP
            $FirstDP
          $SecondMC
           $SecondPP
            $SecondMP
             $SecondDP
 $UpperLeg
  $LowerLeg
   $Foot
    $Toe)",
                            "Left", "Right"};

const Skeleton kMixamoSkeleton{R"(mixamorig:Hips
 mixamorig:Spine
  mixamorig:Spine1
   mixamorig:Spine2
    mixamorig:Neck
     mixamorig:Head
      mixamorig:HeadTop_End
    mixamorig:$Shoulder
     mixamorig:$Arm
      mixamorig:$ForeArm
       mixamorig:$Hand
        mixamorig:$HandThumb1
         mixamorig:$HandThumb2
          mixamorig:$HandThumb3
           mixamorig:$HandThumb4
        mixamorig:$HandIndex1
         mixamorig:$HandIndex2
          mixamorig:$HandIndex3
           mixamorig:$HandIndex4
        mixamorig:$HandPinky1
         mixamorig:$HandPinky2
          mixamorig:$HandPinky3
 mixamorig:$UpLeg
  mixamorig:$Leg
   mixamorig:$Foot
    mixamorig:$ToeBase
     mixamorig:$Toe_End)",
                               "Left", "Right"};

const Skeleton kUnrealSkeleton{R"(root
 pelvis
  spine_01
   spine_02
    spine_03
     spine_04
      spine_05
       neck_01
        neck_02
         head
       clavicle_$
        upperarm_$
         lowerarm_$
          lowerarm_twist_01_$
          hand_$
           thumb_01_$
            thumb_02_$
             thumb_03_$
           index_metacarpal_$
            index_01_$
             index_02_$
              index_03_$
         upperarm_twist_01_$
  thigh_$
   calf_$
    calf_twist_01_$
    foot_$
     ball_$
   thigh_twist_01_$
 ik_foot_root
  ik_foot_$)",
                               "l", "r"};

const Skeleton kUnitySkeleton{R"(Armature
 Hips
  Spine
   Chest
    UpperChest
     Neck
      Head
     $Shoulder
      $UpperArm
       $LowerArm
        $Hand
         $ThumbProximal
          $ThumbIntermediate
           $ThumbDistal
         $IndexProximal
          $IndexIntermediate
           $IndexDistal
  $UpperLeg
   $LowerLeg
    $Foot
     $Toes)",
                              "left", "right"};

const Skeleton kVrmSkeleton{R"(Root
 J_Bip_C_Hips
  J_Bip_C_Spine
   J_Bip_C_Chest
    J_Bip_C_UpperChest
     J_Bip_C_Neck
      J_Bip_C_Head
       J_Sec_Hair1_01
     J_Bip_$_Shoulder
      J_Bip_$_UpperArm
       J_Bip_$_LowerArm
        J_Bip_$_Hand
         J_Bip_$_Thumb1
          J_Bip_$_Thumb2
           J_Bip_$_Thumb3
         J_Bip_$_Index1
          J_Bip_$_Index2
           J_Bip_$_Index3
  J_Bip_$_UpperLeg
   J_Bip_$_LowerLeg
    J_Bip_$_Foot
     J_Bip_$_ToeBase)",
                            "L", "R"};

const Skeleton kRigifySkeleton{R"(root
 DEF-spine
  DEF-spine.001
   DEF-spine.002
    DEF-spine.003
     DEF-spine.004
      DEF-spine.005
       DEF-spine.006
     DEF-shoulder.$
      DEF-upper_arm.$
       DEF-upper_arm.$.001
        DEF-forearm.$
         DEF-forearm.$.001
          DEF-hand.$
           DEF-palm.01.$
            DEF-f_index.01.$
             DEF-f_index.02.$
              DEF-f_index.03.$
           DEF-thumb.01.$
            DEF-thumb.02.$
             DEF-thumb.03.$
  DEF-pelvis.$
  DEF-thigh.$
   DEF-thigh.$.001
    DEF-shin.$
     DEF-shin.$.001
      DEF-foot.$
       DEF-toe.$
 ORG-upper_arm.$
 MCH-upper_arm_ik_target.$)",
                               "L", "R"};

const Skeleton kMetarigSkeleton{R"(spine
 spine.001
  spine.002
   spine.003
    spine.004
     spine.005
      spine.006
    shoulder.$
     upper_arm.$
      forearm.$
       hand.$
        palm.01.$
         f_index.01.$
          f_index.02.$
           f_index.03.$
         thumb.01.$
          thumb.02.$
           thumb.03.$
 pelvis.$
 thigh.$
  shin.$
   foot.$
    toe.$
    heel.02.$)",
                                "L", "R"};

const Skeleton kBipedSkeleton{R"(Bip01
 Bip01 Pelvis
  Bip01 Spine
   Bip01 Spine1
    Bip01 Neck
     Bip01 Head
     Bip01 $ Clavicle
      Bip01 $ UpperArm
       Bip01 $ Forearm
        Bip01 $ Hand
         Bip01 $ Finger0
   Bip01 $ Thigh
    Bip01 $ Calf
     Bip01 $ Foot
      Bip01 $ Toe0
       Bip01 $ Toe0Nub)",
                              "L", "R"};

const Skeleton kAnatomicalSkeleton{R"(root_bind
 pelvis_bind
  spineLow_bind
   spineHigh_bind
    cervical_bind
     skull_bind
    clavicle_$_bind
     humerus_$_bind
      bicepTwist_$_bind
      ulna_$_bind
       wrist_$_bind
        pinky_$_01_bind
         pinky_$_02_bind
          pinky_$_03_bind
  femur_$_bind
   tibia_$_bind
    ankle_$_bind
     ball_$_bind)",
                                   "lf", "rt"};

const Skeleton kPrefixedSkeleton{R"(hero_newSkeleton_root
 hero_newSkeleton_hips
  hero_newSkeleton_$_hip
   hero_newSkeleton_$_knee
    hero_newSkeleton_$_ankle
     hero_newSkeleton_$_ball
  hero_newSkeleton_back01
   hero_newSkeleton_chest01
    hero_newSkeleton_neck01
     hero_newSkeleton_head
    hero_newSkeleton_$_clavicle
     hero_newSkeleton_$_shoulder
      hero_newSkeleton_$_elbow
       hero_newSkeleton_$_wrist)",
                                 "L", "R"};

const Skeleton kGluedSkeleton{R"(hip
 abdomen
  chest
   neck
    head
   $shoulder
    $arm
     $forearm
      $hand
 $thigh
  $shin
   $foot)",
                              "Left", "right"};

const Skeleton kDazSkeleton{R"(hip
 pelvis
  $ThighBend
   $ThighTwist
    $Shin
     $Foot
      $Toe
 abdomenLower
  chestUpper
   neckLower
    neckUpper
     head
   $Collar
    $ShldrBend
     $ShldrTwist
      $ForearmBend
       $ForearmTwist
        $Hand
         $Thumb1
          $Thumb2
           $Thumb3)",
                            "l", "r"};

const Skeleton kJointSkeleton{R"(Hips
 Chest
  Neck
   Head
  $Collar
   $Shoulder
    $Elbow
     $Wrist
 $Hip
  $Knee
   $Ankle
    $Toe)",
                              "Left", "Right"};

std::vector<ImportedBone> namelessBones(const glm::quat& turn, float armsDown) {
    std::vector<ImportedBone> bones;
    for (std::size_t i = 0; i < kSegmentCount; ++i) {
        glm::vec3 place = kReferenceNullPose[i];
        const bool isRight = i >= RightUpperArm && i <= RightHand;
        if (isRight || (i >= LeftUpperArm && i <= LeftHand)) {
            const glm::vec3 shoulder = kReferenceNullPose[isRight ? RightUpperArm : LeftUpperArm];
            const float angle = glm::radians(isRight ? armsDown : -armsDown);
            place = shoulder + glm::angleAxis(angle, glm::vec3(1.0F, 0.0F, 0.0F)) * (place - shoulder);
        }
        bones.push_back({"joint" + std::to_string(i), kSegmentParents[i], turn * place, {}, true});
    }
    return bones;
}

} // namespace posewire::render::test
