// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/bone_names.h"
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

/// How certain a bone is: by the names of a program, by a word for the segment, by the skeleton's shape
/// alone, or because the operator said so.
enum class FoundBy : std::uint8_t { Naming, Word, Shape, Operator };

/// Which bone follows which segment.
struct BoneMapping {
    /// Index of the bone by mappable segment, or -1.
    std::array<int, kMappableCount> bones;
    /// How each bone was found; without meaning if there is none.
    std::array<FoundBy, kMappableCount> foundBy{};
    /// The row of kBoneNamings by which the file names its bones; null for none.
    const BoneNaming* naming = nullptr;

    BoneMapping() { bones.fill(-1); }
    bool operator==(const BoneMapping&) const = default;
};

/// By the names of the bones, in the naming of kBoneNamings that finds most of what is required; what that
/// leaves open by words of kBoneWords, and what these leave open by the skeleton's shape.
BoneMapping mapBones(std::span<const ImportedBone> bones);

/// A bone that the operator gives a segment; no bone if its name is empty.
struct BoneCorrection {
    std::size_t mappable = 0;
    std::string bone;

    bool operator==(const BoneCorrection&) const = default;
};
/// Gives segments other bones; each leaves the segment that had it. Returns those whose bones are not there.
std::vector<BoneCorrection> correct(BoneMapping& mapping, std::span<const ImportedBone> bones,
                                    std::span<const BoneCorrection> corrections);

/// "MVN, Mixamo, … or Character Creator".
std::string knownNamings();

/// Segments without a bone, of those without which a character cannot be posed: pelvis, head, arms with
/// hands, legs with feet.
std::vector<std::size_t> missingSegments(const BoneMapping& mapping);

/// Fails with what makes a mapping unfit: which segments have no bone and which names are known, or which
/// bone of a limb does not hang on the one before it.
tl::expected<void, std::string> checkMapping(const BoneMapping& mapping, std::span<const ImportedBone> bones);

} // namespace posewire::render
