// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/bone_mapping.h"

#include <array>
#include <span>
#include <string_view>

namespace posewire::render {

/// Words for a segment, whoever made the file. The first that a file has counts; a bone has one segment, that
/// of the earliest row.
struct BoneWords {
    /// Of the right side if it has one.
    Segment segment;
    bool isSided;
    std::string_view words;
};

/// Required segments come first: a file that calls an upper arm "shoulder" has another word for the clavicle.
inline constexpr std::array kBoneWords{
    BoneWords{Pelvis, false, "pelvis|hips|hip|sacrum|bodyroot"},
    BoneWords{Head, false, "head|skull|cranium"},
    BoneWords{Neck, false, "neck|necklower|cervical"},
    BoneWords{RightUpperArm, true,
              "upperarm|armupper|uparm|uarm|humerus|bicep|biceps|shldr|shoulderjoint|arm|shoulder"},
    BoneWords{RightForeArm, true, "forearm|lowerarm|armlower|lowarm|loarm|farm|ulna|radius|elbow"},
    BoneWords{RightHand, true, "wrist|hand|palm|carpus"},
    BoneWords{RightUpperLeg, true, "upperleg|legupper|upleg|thigh|femur|hipjoint|hip|leg"},
    BoneWords{RightLowerLeg, true, "lowerleg|leglower|lowleg|loleg|shin|calf|tibia|fibula|knee|leg"},
    BoneWords{RightFoot, true, "ankle|foot|feet|talus"},
    BoneWords{RightShoulder, true, "clavicle|collar|collarbone|clav|scapula|shoulder"},
    BoneWords{RightToe, true, "toebase|toes|toe|ball|metatarsals|foot"},
};

/// Thumb, index, middle, ring, little.
inline constexpr std::array<std::string_view, 5> kFingerWords{"thumb|pollex", "index|indexfinger|pointer",
                                                              "middle|mid|middlefinger", "ring|ringfinger",
                                                              "little|pinky|pinkie|littlefinger"};

/// Bones beside those that move a segment.
inline constexpr std::string_view kHelperWords =
    "|twist|roll|ik|fk|pole|end|nub|tip|effector|target|helper|ctrl|control|handle|mch|org|bank|";

/// Finds bones by words of kBoneWords, in any letter case, order and company. The spine stays unmapped.
BoneMapping mapBonesByWords(std::span<const ImportedBone> bones);

} // namespace posewire::render
