// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/points.h"
#include "core/model/body/segments.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

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

/// The least first.
enum class BodySource : std::uint8_t {
    Reference, ///< nothing: the reference body
    Poses,     ///< lengths of bones, measured on poses
    NullPose,  ///< a scale message
};

/// The axis about which a limb of two bones bends, in the frame of each: upper × lower bone. Zero if it is
/// not known.
struct LimbBend {
    Eigen::Vector3d upper = Eigen::Vector3d::Zero();
    Eigen::Vector3d lower = Eigen::Vector3d::Zero();
};

/// A body in the null pose. Metres.
struct BodyOrigins {
    struct Point {
        int segment = 0;                                    ///< body segment index
        int localId = 0;                                    ///< 1-based within the segment
        Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< from the segment's origin
    };
    std::array<Eigen::Vector3d, kBodySegmentCount> places; ///< origins of the body segments
    double floor = 0;                                      ///< z of the soles
    BodySource source = BodySource::Reference;
    bool hasMeshScale = false;       ///< a scale of type 10 came, which tells no lengths
    std::vector<Point> points{};     ///< as sent; see pointOf() for those that were not
    std::array<LimbBend, 6> bends{}; ///< of arms, legs, and shanks with feet; each right, left

    /// The pelvis above the soles, against the reference body.
    [[nodiscard]] double scale() const;
    /// From the segment's origin: as sent, else that of the reference body, scaled; empty if there is no
    /// such point.
    [[nodiscard]] std::optional<Eigen::Vector3d> pointOf(int segment, int localId) const;
};

/// Origins of the 1.75 m reference body, floor at z = 0: leg, arm and total lengths from the ratios of
/// Drillis and Contini as printed in Winter, trunk split and offsets as measured in public MVN recordings.
const std::array<Eigen::Vector3d, kBodySegmentCount>& referenceOrigins();

/// Scales everything by stature, then limbs and breadths by their factors, keeping the soles on the floor.
ReferenceBody makeReferenceBody(const BodyProportions& proportions = {});

} // namespace posewire::model
