// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/character_file.h"
#include "render/mesh/joints.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace posewire::render {

/// What a bone can be mapped to: the 23 segments of the body, then the segments of both hands.
inline constexpr std::size_t kMappableCount = kSegmentCount + kFingerJointCount;

/// The joint of the mannequin that a mappable segment is.
constexpr std::size_t mappableJoint(std::size_t mappable) {
    return mappable < kSegmentCount ? mappable : mappable - kSegmentCount + kFirstFingerJoint;
}
/// MVN's name, "LeftUpperArm".
constexpr std::string_view mappableName(std::size_t mappable) {
    return kJointNames[mappableJoint(mappable)];
}
/// What people read: "Left Upper Arm".
std::string mappableTitle(std::size_t mappable);
/// Without a bone for it a character cannot be posed: pelvis, head, arms with hands, legs with feet.
bool isRequired(std::size_t mappable);

/// Whose habit the bones of a file are named by.
enum class BoneNaming : std::uint8_t { Unknown, Mvn, Mixamo, Unreal, Humanoid, Rigify, Biped };
/// "Mixamo", "VRM or Unity humanoid"; "unknown".
std::string_view titleOf(BoneNaming naming);

/// Which bone follows which segment.
struct BoneMapping {
    /// Index of the bone by mappable segment, or -1.
    std::array<int, kMappableCount> bones;
    BoneNaming naming = BoneNaming::Unknown;

    BoneMapping() { bones.fill(-1); }
    bool operator==(const BoneMapping&) const = default;
};

/// By the names of the bones, whatever their case and prefixes, and where those leave it open by what hangs
/// on what: spines of any number of bones are spread over L5, L3, T12 and T8.
BoneMapping mapBones(std::span<const ImportedBone> bones);

/// Required segments without a bone.
std::vector<std::size_t> missingSegments(const BoneMapping& mapping);

/// What makes a mapping unfit: something required is missing, one bone is named twice or is not there, or a
/// limb's bone does not hang on the one before it.
tl::expected<void, std::string> checkMapping(const BoneMapping& mapping, std::span<const ImportedBone> bones);

/// The name of a bone as mapping reads it.
struct BoneName {
    enum class Side : std::uint8_t { None, Left, Right };
    /// In lower case, without the side and without prefixes: "upperarm", "spine1".
    std::string key;
    Side side = Side::None;
    /// 0 thumb to 4 little finger, or -1.
    int finger = -1;
    /// Within the finger as MVN counts: 0 MC, 1 PP, 2 MP (thumb: DP), 3 DP; -1 where that is not said.
    int phalanx = -1;
    /// A twist bone, an end, a handle: never a segment.
    bool isExtra = false;
};
BoneName readBoneName(std::string_view name);

} // namespace posewire::render
