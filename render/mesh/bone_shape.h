// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/bone_mapping.h"

#include <span>

namespace posewire::render {

/// Finds trunk, arms and legs by where bones are and how they hang together, whatever their names: two
/// branches that mirror each other and lead down are legs, two above them arms, what leads up between these
/// is the head. In each limb the two long bones that follow each other are its upper and lower one. Left is
/// what toes say, else knees, else the convention of glTF. Returns an empty mapping if there is no such body.
/// The spine stays unmapped.
BoneMapping mapBonesByShape(std::span<const ImportedBone> bones);

} // namespace posewire::render
