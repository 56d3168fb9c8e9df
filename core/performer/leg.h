// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/body_pose.h"

#include <array>

namespace posewire::performer {

/// Where a leg has to go: the ankle, the world orientation of the foot, and the upper leg's orientation as a
/// preference, which decides where the knee points.
struct LegGoal {
    Eigen::Vector3d ankle = Eigen::Vector3d::Zero();
    Eigen::Quaterniond foot = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond upperLegWish = Eigen::Quaterniond::Identity();
};

/// Two-bone inverse kinematics for one leg. The hip comes from `pose`, whose pelvis must be in place; upper
/// leg, lower leg, foot and toe of `rotations` and `pose` are written (the toe keeps its rotation against the
/// foot). A goal out of reach is approached softly, so that the knee never snaps: the last 2 % of the way are
/// shortened, by 4 mm at most within the leg's length.
void reach(const model::ReferenceBody& body, model::Side side, const LegGoal& goal, LocalRotations& rotations,
           BodyPose& pose);

/// Seven points of the sole in the frames of foot (first four: heel, ball inner, ball outer, ball middle) and
/// toe (ball inner, ball outer, tip), on the 1.75 m body at sole height.
struct SolePoint {
    bool onToe = false;
    Eigen::Vector3d position;
};
inline constexpr int kSolePointCount = 7;
const std::array<SolePoint, kSolePointCount>& solePoints();

/// The sole points of one side in the world.
std::array<Eigen::Vector3d, kSolePointCount> worldSolePoints(const model::ReferenceBody& body,
                                                             model::Side side, const BodyPose& pose);

} // namespace posewire::performer
