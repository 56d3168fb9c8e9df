// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/character_file.h"

#include <string>
#include <string_view>
#include <vector>

namespace posewire::render::test {

/// Bones from lines: one more blank at the beginning than the line above is its child. Lines with a $ stand
/// for two branches: left words in its place first, then right ones.
std::vector<ImportedBone> bonesOf(std::string_view tree, std::string_view left, std::string_view right);

struct Skeleton {
    std::string_view tree;
    std::string_view left;
    std::string_view right;

    std::vector<ImportedBone> bones() const { return bonesOf(tree, left, right); }
};

/// As each of them names and joins its bones.
extern const Skeleton kMvnSkeleton;
extern const Skeleton kMixamoSkeleton;
extern const Skeleton kUnrealSkeleton;
extern const Skeleton kUnitySkeleton;
extern const Skeleton kVrmSkeleton;
extern const Skeleton kRigifySkeleton;
extern const Skeleton kMetarigSkeleton;
extern const Skeleton kBipedSkeleton;
extern const Skeleton kAnatomicalSkeleton;
extern const Skeleton kPrefixedSkeleton;
extern const Skeleton kGluedSkeleton;
extern const Skeleton kDazSkeleton;
extern const Skeleton kJointSkeleton;

/// MVN's 23 segments in the reference null pose, with names that say nothing. `turn` stands them otherwise,
/// `armsDown` (degrees) lowers the arms.
std::vector<ImportedBone> namelessBones(const glm::quat& turn = {1.0F, 0.0F, 0.0F, 0.0F},
                                        float armsDown = 0.0F);

} // namespace posewire::render::test
