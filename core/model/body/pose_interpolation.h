// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/body/character_pose.h"

#include <chrono>

namespace posewire::model {

/// A body between its samples, for displays that are faster than the stream. It glides from what was shown
/// when a sample came to that sample, in the time that lay between the two last samples: one sample late at
/// most, never beyond what was sent, and without a jump.
class PoseInterpolation {
public:
    /// After a longer time without a sample nothing is made up.
    static constexpr log::Duration kLongest = std::chrono::milliseconds(250);

    /// What to show at `now`, which only grows, where `newest` is the newest pose: that itself where nothing
    /// came before it, after kLongest, where another number of segments was sent, or where samples come as
    /// fast as this is asked. Valid until it is asked again.
    const CharacterPose& at(const CharacterPose& newest, log::Stamp now);
    /// True if the same newest pose will be shown elsewhere later.
    [[nodiscard]] bool isUnderWay() const { return m_isUnderWay; }

private:
    [[nodiscard]] bool isContinued(const CharacterPose& newest) const;
    void begin(const CharacterPose& newest);

    CharacterPose m_from;   ///< shown when the newest sample came
    CharacterPose m_newest; ///< as it was sent
    CharacterPose m_shown;
    log::Duration m_time{}; ///< from sample to sample
    int m_asked = 0;        ///< times that the newest sample has been shown
    bool m_isGliding = false;
    bool m_isUnderWay = false;
};

} // namespace posewire::model
