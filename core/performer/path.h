// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/periodic_spline.h"

#include <Eigen/Core>

namespace posewire::performer {

/// A place on the floor and the direction of the path there. Metres, radians.
struct PathPlace {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    double heading = 0.0;   ///< about z, from the x-axis
    double curvature = 0.0; ///< 1/m, left turns +
};

/// A lemniscate of Bernoulli with its crossing at `centre`, walked at even speed. Curvature grows evenly from
/// zero at the crossing to 3 / `halfWidth` at the far ends.
class FigureOfEight {
public:
    explicit FigureOfEight(double halfWidth, const Eigen::Vector2d& centre = Eigen::Vector2d::Zero());

    /// Length of one lap, in metres.
    double length() const { return m_length; }

    /// The place `distance` metres after the crossing (any number, taken modulo the length).
    PathPlace at(double distance) const;

private:
    double m_length = 0.0;
    PeriodicSpline<Eigen::Vector4d> m_places; ///< x, y, heading, curvature by share of the lap
};

} // namespace posewire::performer
