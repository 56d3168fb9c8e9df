// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/character_pose.h"

#include <vector>

namespace posewire::model {

/// Nearer to the floor than this, a point of a sole stands on it: soles of recordings are up to 4 mm above
/// it, and flesh gives way. Metres.
inline constexpr double kContactHeight = 0.02;

/// Points of both soles (heel, balls, tip of the toe) that stand on the floor z = 0, in the world.
[[nodiscard]] std::vector<Eigen::Vector3d> soleContacts(const CharacterPose& pose, const BodyOrigins& body);

/// Convex hull of points as seen from above, counter-clockwise (monotone chain, Andrew 1979): the base of
/// support. Fewer than three where the points lie on a line.
[[nodiscard]] std::vector<Eigen::Vector3d> supportPolygon(std::vector<Eigen::Vector3d> points);

} // namespace posewire::model
