// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/character_pose.h"

#include <cstdint>
#include <vector>

namespace posewire::model {

enum class DifferenceFrame : std::uint8_t {
    World,   ///< nothing: as they were sent
    Heading, ///< the pelvis' place on the floor and which way it faces; its height and tilt count
    Pelvis,  ///< the pelvis, place and turn: what is left is the pose alone
};

struct SegmentDifference {
    int slot = 0;  ///< see kAllSegments
    int first = 0; ///< position in the pose of the one, and of the other
    int second = 0;
    double millimetres = 0; ///< between the origins
    double degrees = 0;     ///< of the one turn that takes one orientation to the other
};

struct PoseDifference {
    std::vector<SegmentDifference> segments; ///< that both have, in the order of kAllSegments
    /// Takes the second body to where it is compared with the first: a rigid motion of the world.
    SegmentPose overlay;

    /// Null if not both have the segment.
    [[nodiscard]] const SegmentDifference* find(int slot) const;
    /// Over all segments; 0 without any.
    [[nodiscard]] double meanMillimetres() const;
    [[nodiscard]] double meanDegrees() const;
};

/// Of where they were sent, or solved: that the operator has put a body on the floor does not count. False,
/// and nothing is compared, where they have no segment in common, one is of tracked objects, or one lacks
/// the pelvis that they are to be laid over each other by.
[[nodiscard]] bool differenceOf(const CharacterPose& first, const CharacterPose& second,
                                DifferenceFrame frame, PoseDifference& difference);

/// Of the turn from one orientation to another, from 0 to 180; exact for small ones too.
[[nodiscard]] double degreesBetween(const Eigen::Quaterniond& first, const Eigen::Quaterniond& second);

} // namespace posewire::model
