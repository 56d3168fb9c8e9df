// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/character_pose.h"

#include <array>
#include <vector>

namespace posewire::model {

/// Nearer to the floor than this, a point of a sole stands on it: soles of recordings are up to 4 mm above
/// it, and flesh gives way. Metres.
inline constexpr double kContactHeight = 0.02;

/// Points of both soles: heel, balls, tip of the toe.
struct SolePoint {
    int segment;
    int localId;
};
inline constexpr std::array<SolePoint, 8> kSolePoints{{
    {segment::kRightFoot, 3},
    {segment::kRightFoot, 4},
    {segment::kRightFoot, 5},
    {segment::kRightToe, 2},
    {segment::kLeftFoot, 3},
    {segment::kLeftFoot, 4},
    {segment::kLeftFoot, 5},
    {segment::kLeftToe, 2},
}};

/// Those that stand on the floor z = 0, in the world.
[[nodiscard]] std::vector<Eigen::Vector3d> soleContacts(const CharacterPose& pose, const BodyOrigins& body);

/// Convex hull of points as seen from above, counter-clockwise (monotone chain, Andrew 1979): the base of
/// support. Fewer than three where the points lie on a line.
[[nodiscard]] std::vector<Eigen::Vector3d> supportPolygon(std::vector<Eigen::Vector3d> points);

} // namespace posewire::model
