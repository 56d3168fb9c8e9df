// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/body/character_pose.h"
#include "core/model/body/null_pose.h"
#include "core/model/body/reference_body.h"
#include "render/skinning.h"

#include <array>

namespace posewire::gui {

/// The fingers of one character as the palette wants them, the left hand first.
struct PosedHands {
    std::array<glm::vec3, render::kFingerJointCount> positions{};
    std::array<glm::quat, render::kFingerJointCount> orientations{};
    bool hasLeft = false;
    bool hasRight = false;

    [[nodiscard]] render::FingerPose left() const;
    [[nodiscard]] render::FingerPose right() const;
};

/// A hand without any finger in the pose is left out; of others, missing segments are not numbers.
[[nodiscard]] PosedHands handsOf(const model::CharacterPose& pose);

/// Where a scale message has the fingers, moved to where `body` has the hands; not a number where it has
/// none.
[[nodiscard]] render::FingerOrigins fingerOriginsOf(const model::NullPose& nullPose,
                                                    const model::BodyOrigins& body);

} // namespace posewire::gui
