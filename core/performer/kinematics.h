// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/reference_body.h"
#include "core/model/body/spaces.h"

#include <array>
#include <span>

namespace posewire::performer {

using BodyPose = std::array<model::SegmentPose, model::kBodySegmentCount>;

/// How each segment is turned against its parent; the pelvis against the world.
struct LocalRotations {
    std::array<Eigen::Quaterniond, model::kBodySegmentCount> values;

    LocalRotations() { values.fill(Eigen::Quaterniond::Identity()); }
    Eigen::Quaterniond& operator[](int segment) { return values[static_cast<std::size_t>(segment)]; }
    const Eigen::Quaterniond& operator[](int segment) const {
        return values[static_cast<std::size_t>(segment)];
    }
};

/// Forward kinematics with the pelvis at `root`.
BodyPose posed(const model::ReferenceBody& body, const Eigen::Vector3d& root,
               const LocalRotations& rotations);

/// Rotations about the axes, in degrees, the unit of the motions.
Eigen::Quaterniond aboutX(double degrees);
Eigen::Quaterniond aboutY(double degrees);
Eigen::Quaterniond aboutZ(double degrees);

/// +1 on the left, -1 on the right: the sign of y.
inline double sideSign(model::Side side) {
    return side == model::Side::Left ? 1.0 : -1.0;
}

/// The segments of one arm and one leg, by side.
struct LimbSegments {
    int shoulder, upperArm, foreArm, hand, upperLeg, lowerLeg, foot, toe;
};
const LimbSegments& limbs(model::Side side);

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

inline constexpr int kSolePointCount = 7;

/// Seven points of one sole in the world: four of the foot (heel, ball inner, outer and middle), three of the
/// toe (ball inner and outer, tip).
std::array<Eigen::Vector3d, kSolePointCount> worldSolePoints(const model::ReferenceBody& body,
                                                             model::Side side, const BodyPose& pose);

/// A segment with its first and second derivatives, all in the world.
struct SegmentState {
    model::SegmentPose pose;
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
    Eigen::Vector3d angularVelocity = Eigen::Vector3d::Zero();     ///< rad/s
    Eigen::Vector3d angularAcceleration = Eigen::Vector3d::Zero(); ///< rad/s²
};

/// Position, velocity and acceleration of a point.
struct PointState {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
};

/// Central differences over three moments `step` seconds apart.
PointState differentiated(const Eigen::Vector3d& before, const Eigen::Vector3d& now,
                          const Eigen::Vector3d& after, double step);

/// The rotation vector of `to` against `from`, in the world: axis times angle, the shorter way round.
Eigen::Vector3d rotationBetween(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to);

/// As many segments at three moments, `step` seconds apart.
struct ThreeMoments {
    std::span<const model::SegmentPose> before;
    std::span<const model::SegmentPose> now;
    std::span<const model::SegmentPose> after;
    double step = 0.0;
};

/// The states of the segments at the middle one of three moments; as many as there are segments.
void differentiate(const ThreeMoments& moments, std::span<SegmentState> states);

/// Centre of mass of the body, from the 23 segments in the world. Each segment's own centre lies on the way
/// from its origin to the far joint, at the shares tabulated by
/// Winter; masses after Dempster and Winter, the trunk split over its segments.
Eigen::Vector3d centreOfMass(const model::ReferenceBody& body, std::span<const model::SegmentPose> segments);

} // namespace posewire::performer
