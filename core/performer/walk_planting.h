// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/leg.h"

#include <array>
#include <vector>

namespace posewire::performer {

/// The sole points of both feet (right, left) at equally spaced phases of one cycle, relative to the pelvis
/// origin.
using SoleFrame = std::array<std::array<Eigen::Vector3d, kSolePointCount>, 2>;

/// From the feet to the way of the pelvis: its height puts the lowest point of the carrying feet on the
/// floor, its velocity is the opposite of the mean velocity of the points that touch it. Both are smoothed by
/// about 40 ms.
struct RootJob {
    const std::vector<SoleFrame>& soles;
    std::vector<Eigen::Vector3d>& roots; ///< against an evenly moving point, same size as `soles`
    double& strideLength;

    bool validate() const;
    void run() const;
};

/// What keeps a foot from slipping, sinking and floating once the pelvis moves as RootJob says.
struct PlantingJob {
    const std::vector<SoleFrame>& soles;
    const std::vector<Eigen::Vector3d>& roots;
    double strideLength;
    model::Side side;
    std::vector<Eigen::Vector3d>& corrections; ///< same size as `soles`

    bool validate() const;
    void run() const;
};

} // namespace posewire::performer
