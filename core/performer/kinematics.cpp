// SPDX-License-Identifier: MIT
#include "core/performer/kinematics.h"

#include <cmath>

namespace posewire::performer {

using Eigen::Quaterniond;
using Eigen::Vector3d;

PointState differentiated(const Vector3d& before, const Vector3d& now, const Vector3d& after, double step) {
    return {now, (after - before) / (2.0 * step), (after - 2.0 * now + before) / (step * step)};
}

Vector3d rotationBetween(const Quaterniond& from, const Quaterniond& to) {
    Quaterniond way = to * from.conjugate();
    if (way.w() < 0.0) {
        way.coeffs() = -way.coeffs();
    }
    const double sine = way.vec().norm();
    constexpr double kTiny = 1e-12;
    if (sine < kTiny) {
        return 2.0 * way.vec();
    }
    return way.vec() * (2.0 * std::atan2(sine, way.w()) / sine);
}

bool KinematicsJob::validate() const {
    return step > 0.0 && before.size() == now.size() && after.size() == now.size() &&
           states.size() == now.size();
}

void KinematicsJob::run() const {
    for (std::size_t index = 0; index < now.size(); ++index) {
        const PointState point =
            differentiated(before[index].position, now[index].position, after[index].position, step);
        const Vector3d first = rotationBetween(before[index].orientation, now[index].orientation) / step;
        const Vector3d second = rotationBetween(now[index].orientation, after[index].orientation) / step;
        states[index] = {now[index], point.velocity, point.acceleration, 0.5 * (first + second),
                         (second - first) / step};
    }
}

} // namespace posewire::performer
