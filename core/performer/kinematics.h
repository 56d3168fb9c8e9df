// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/body_pose.h"

#include <span>

namespace posewire::performer {

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
