// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace posewire::render {

/// How one program names the bones of a character. Case, punctuation and what stands before all names of a
/// file do not count. `$` stands for the side, `%` for the finger, `#` for its number from the index finger
/// on; of names with `|` between them the first that a file has counts.
struct BoneNaming {
    std::string_view title;
    std::string_view left;
    std::string_view right;
    std::string_view pelvis;
    /// Between pelvis and neck, from below: as many of them as a file has are spread over L5, L3, T12 and T8.
    std::array<std::string_view, 5> spine;
    std::string_view neck;
    std::string_view head;
    /// Shoulder, upper arm, forearm, hand; upper leg, lower leg, foot, toe.
    std::array<std::string_view, 8> limbs;
    std::string_view carpus;
    std::array<std::string_view, 3> thumb;     ///< MC, PP, DP
    std::array<std::string_view, 4> fingers;   ///< index, middle, ring, little
    std::array<std::string_view, 4> phalanges; ///< of these: MC, PP, MP, DP
};

/// To add a naming: a row.
inline constexpr std::array kBoneNamings{
    BoneNaming{"MVN",
               "Left",
               "Right",
               "Pelvis",
               {"L5", "L3", "T12", "T8"},
               "Neck",
               "Head",
               {"$Shoulder", "$UpperArm", "$ForeArm", "$Hand", "$UpperLeg", "$LowerLeg", "$Foot", "$Toe"},
               "$Carpus",
               {"$FirstMC", "$FirstPP", "$FirstDP"},
               {"Second", "Third", "Fourth", "Fifth"},
               {"$%MC", "$%PP", "$%MP", "$%DP"}},
    BoneNaming{"Mixamo",
               "Left",
               "Right",
               "Hips",
               {"Spine", "Spine1", "Spine2", "Spine3"},
               "Neck",
               "Head",
               {"$Shoulder", "$Arm", "$ForeArm", "$Hand", "$UpLeg", "$Leg", "$Foot", "$ToeBase"},
               "",
               {"$HandThumb1", "$HandThumb2", "$HandThumb3"},
               {"Index", "Middle", "Ring", "Pinky"},
               {"$InHand%", "$Hand%1", "$Hand%2", "$Hand%3"}},
    BoneNaming{"Unreal",
               "l",
               "r",
               "pelvis",
               {"spine_01", "spine_02", "spine_03", "spine_04", "spine_05"},
               "neck_01",
               "head",
               {"clavicle_$", "upperarm_$", "lowerarm_$", "hand_$", "thigh_$", "calf_$", "foot_$", "ball_$"},
               "",
               {"thumb_01_$", "thumb_02_$", "thumb_03_$"},
               {"index", "middle", "ring", "pinky"},
               {"%_metacarpal_$", "%_01_$", "%_02_$", "%_03_$"}},
    BoneNaming{
        "VRM or Unity humanoid",
        "Left",
        "Right",
        "Hips",
        {"Spine", "Chest", "UpperChest"},
        "Neck",
        "Head",
        {"$Shoulder", "$UpperArm", "$LowerArm", "$Hand", "$UpperLeg", "$LowerLeg", "$Foot", "$Toes|$ToeBase"},
        "",
        {"$ThumbMetacarpal|$ThumbProximal", "$ThumbIntermediate|$ThumbProximal", "$ThumbDistal"},
        {"Index", "Middle", "Ring", "Little"},
        {"", "$%Proximal", "$%Intermediate", "$%Distal"}},
    BoneNaming{"VRoid Studio",
               "L",
               "R",
               "C_Hips",
               {"C_Spine", "C_Chest", "C_UpperChest"},
               "C_Neck",
               "C_Head",
               {"$_Shoulder", "$_UpperArm", "$_LowerArm", "$_Hand", "$_UpperLeg", "$_LowerLeg", "$_Foot",
                "$_ToeBase"},
               "",
               {"$_Thumb1", "$_Thumb2", "$_Thumb3"},
               {"Index", "Middle", "Ring", "Little"},
               {"", "$_%1", "$_%2", "$_%3"}},
    BoneNaming{"Blender Rigify",
               "L",
               "R",
               "spine",
               {"spine.001", "spine.002", "spine.003"},
               "spine.004",
               "spine.006",
               {"shoulder.$", "upper_arm.$", "forearm.$", "hand.$", "thigh.$", "shin.$", "foot.$", "toe.$"},
               "",
               {"thumb.01.$", "thumb.02.$", "thumb.03.$"},
               {"index", "middle", "ring", "pinky"},
               {"palm.0#.$", "f_%.01.$", "f_%.02.$", "f_%.03.$"}},
    BoneNaming{"3ds Max Biped",
               "L",
               "R",
               "Pelvis",
               {"Spine", "Spine1", "Spine2", "Spine3"},
               "Neck",
               "Head",
               {"$ Clavicle", "$ UpperArm", "$ Forearm", "$ Hand", "$ Thigh", "$ Calf", "$ Foot", "$ Toe0"},
               "",
               {"$ Finger0", "$ Finger01", "$ Finger02"},
               {"1", "2", "3", "4"},
               {"", "$ Finger%", "$ Finger%1", "$ Finger%2"}},
    BoneNaming{
        "Character Creator",
        "L",
        "R",
        "Pelvis",
        {"Waist", "Spine01", "Spine02"},
        "NeckTwist01",
        "Head",
        {"$_Clavicle", "$_Upperarm", "$_Forearm", "$_Hand", "$_Thigh", "$_Calf", "$_Foot", "$_ToeBase"},
        "",
        {"$_Thumb1", "$_Thumb2", "$_Thumb3"},
        {"Index", "Mid", "Ring", "Pinky"},
        {"", "$_%1", "$_%2", "$_%3"}},
};

} // namespace posewire::render
