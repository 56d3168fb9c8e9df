// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/spaces.h"

#include <span>
#include <vector>

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

/// Derives the states of segments at the middle of three moments `step` seconds apart.
struct KinematicsJob {
    std::span<const model::SegmentPose> before;
    std::span<const model::SegmentPose> now;
    std::span<const model::SegmentPose> after;
    double step = 0.0;
    std::span<SegmentState> states;

    bool validate() const;
    void run() const;
};

} // namespace posewire::performer
