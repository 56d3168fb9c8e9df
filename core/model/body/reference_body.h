// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/points.h"
#include "core/model/body/segments.h"

#include <Eigen/Core>

#include <array>

namespace posewire::model {

inline constexpr double kReferenceStature = 1.75;

/// In MVN's null pose the ball of the foot is at z = 0; the floor is this much lower on the reference body.
inline constexpr double kReferenceSoleDrop = 0.015;

/// What makes one body differ from another: stature in metres, and factors on top of it.
struct BodyProportions {
    double stature = kReferenceStature;
    double legs = 1.0;      ///< length of thigh and shank
    double arms = 1.0;      ///< length of upper arm, forearm and hand
    double shoulders = 1.0; ///< breadth
    double hips = 1.0;      ///< breadth
};

/// A body in the null pose: T-pose, X forward, Y left, Z up, every orientation the identity. Metres.
struct ReferenceBody {
    std::array<Eigen::Vector3d, kBodySegmentCount> origins; ///< floor at z = 0
    std::array<Eigen::Vector3d, kPointCount> points; ///< relative to their segment, in the order of points.h
    double stature = kReferenceStature;
    double soleDrop = kReferenceSoleDrop;

    /// Origin in the frame of a type 13 message, where the ball of the foot is at z = 0.
    Eigen::Vector3d nullPoseOrigin(int segment) const;
    /// Origin relative to the parent segment's; the origin itself for the pelvis.
    Eigen::Vector3d offset(int segment) const;
    /// Sum of thigh and shank.
    double legLength() const;
};

/// Origins of the 23 body segments in the null pose, in metres.
struct BodyOrigins {
    std::array<Eigen::Vector3d, kBodySegmentCount> places;
};

/// Origins of the 1.75 m reference body, floor at z = 0: leg, arm and total lengths from the ratios of
/// Drillis and Contini as printed in Winter, trunk split and offsets as measured in public MVN recordings.
const std::array<Eigen::Vector3d, kBodySegmentCount>& referenceOrigins();

/// Scales everything by stature, then limbs and breadths by their factors, keeping the soles on the floor.
ReferenceBody makeReferenceBody(const BodyProportions& proportions = {});

} // namespace posewire::model
