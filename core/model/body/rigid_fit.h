// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include <optional>
#include <span>

namespace posewire::model {

/// A vector that is fixed to a segment, and the same as it is in the world. Vectors of 0.1 m have the weight
/// that is given, longer and shorter ones by the square of their length.
struct VectorPair {
    Eigen::Vector3d local = Eigen::Vector3d::Zero();
    Eigen::Vector3d world = Eigen::Vector3d::Zero();
    double weight = 1.0;
};

enum class RotationRank : std::uint8_t { Nothing, Direction, Whole };

struct FittedRotation {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity(); ///< worldFromSegment
    RotationRank rank = RotationRank::Nothing;
};

/// The rotation that turns the local vectors onto those in the world with the least squared error (Wahba
/// 1965, by singular values as Markley 1988). What they leave open is nearest to `prior`, which weighs so
/// little that it plays no part elsewhere, or as much as three vectors of `priorWeight`; so the result moves
/// steadily when the vectors do.
[[nodiscard]] FittedRotation fitRotation(std::span<const VectorPair> vectors, const Eigen::Quaterniond& prior,
                                         double priorWeight = 0);

/// A marker of a segment.
struct MarkerPair {
    Eigen::Vector3d local = Eigen::Vector3d::Zero(); ///< metres, from the segment's origin
    Eigen::Vector3d world = Eigen::Vector3d::Zero();
};

struct RigidFit {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity(); ///< worldFromSegment
    Eigen::Vector3d position = Eigen::Vector3d::Zero();           ///< of the segment's origin
    double worst = 0;                                             ///< greatest distance that is left, metres
};

/// Rigid fit of markers (Kabsch 1976). Two that changed places are changed back; one that lies farther off
/// than `tolerance` is left out, as long as three are left. Nothing if there are fewer than three, where
/// they lie within 8 mm of a line, or where they do not agree.
[[nodiscard]] std::optional<RigidFit> fitMarkers(std::span<const MarkerPair> markers, double tolerance);

} // namespace posewire::model
