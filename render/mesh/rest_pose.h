// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/own_body.h"

namespace posewire::render {

/// The rest pose of a file in metres, Z-up, X ahead.
struct RestPose {
    /// What turns the file's directions into that.
    glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};
    /// Of each bone.
    std::vector<glm::vec3> origins;
    RestReading reading;
};

/// By where the mapped bones are: up is from the feet to the head, left is where the left limbs are.
tl::expected<RestPose, std::string> readRestPose(const ImportedCharacter& character,
                                                 const BoneMapping& mapping, const RestChoice& choice);

/// By bone: the segment of a limb whose bone it stands beside, or -1. Bones that spread the twist of a limb,
/// or half of its swing, often hang on the same parent as the limb's bone and begin where that does.
std::vector<int> limbsBeside(std::span<const ImportedBone> bones, const BoneMapping& mapping,
                             std::span<const glm::vec3> origins);

/// What turns each bone from there into MVN's T-pose: limbs along their axes, palms down, feet ahead. Trunk,
/// shoulders and head stay as the file has them; bones without a segment turn as the limb that they stand
/// beside, or as their parent.
std::vector<glm::quat> straightTurns(std::span<const ImportedBone> bones, const BoneMapping& mapping,
                                     std::span<const glm::vec3> origins, bool isStraightened);

} // namespace posewire::render
