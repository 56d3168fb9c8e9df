// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/leg.h"

#include <array>
#include <vector>

namespace posewire::performer {

/// The sole points of both feet (right, left) at equally spaced phases of one cycle, relative to the pelvis
/// origin.
using SoleFrame = std::array<std::array<Eigen::Vector3d, kSolePointCount>, 2>;

/// How the pelvis moves over one cycle.
struct PelvisPath {
    std::vector<Eigen::Vector3d> roots; ///< against an evenly moving point, one for each frame of the soles
    double strideLength = 0.0;          ///< metres
};

/// From the feet: the height of the pelvis puts the lowest point of the feet that carry it on the floor, its
/// velocity is the opposite of the mean velocity of the points that touch it. Both are smoothed by about
/// 40 ms. Takes at least 32 frames.
PelvisPath pelvisPath(const std::vector<SoleFrame>& soles);

/// What keeps a foot from slipping, sinking and floating while the pelvis moves along `path`; one for each
/// frame of the soles.
std::vector<Eigen::Vector3d> footCorrections(const std::vector<SoleFrame>& soles, const PelvisPath& path,
                                             model::Side side);

} // namespace posewire::performer
