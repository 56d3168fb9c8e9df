// SPDX-License-Identifier: MIT
#include "core/performer/kinematics.h"

#include <cmath>
#include <numeric>

namespace posewire::performer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Mass {
    double share;  ///< as tabulated; head, trunk and limbs together make 1.0 but for rounding
    double centre; ///< share of the way to the second point of the segment, the joint that it reaches to; the
                   ///< rib cage reaches far below the joint at which T8 begins
};

constexpr std::array<Mass, model::kBodySegmentCount> kMasses{{
    {0.142, 0.5},                                                    // pelvis
    {0.046, 0.5},   {0.046, 0.5},    {0.047, 0.5},                   // L5, L3, T12
    {0.160, -0.3},  {0.020, 0.5},    {0.061, 0.5},                   // T8, neck, head
    {0.028, 0.5},   {0.028, 0.436},  {0.016, 0.430}, {0.006, 0.506}, // right arm
    {0.028, 0.5},   {0.028, 0.436},  {0.016, 0.430}, {0.006, 0.506}, // left arm
    {0.100, 0.433}, {0.0465, 0.433}, {0.0115, 0.5},  {0.003, 0.5},   // right leg
    {0.100, 0.433}, {0.0465, 0.433}, {0.0115, 0.5},  {0.003, 0.5},   // left leg
}};

constexpr double kTabulatedSum = std::accumulate(
    kMasses.begin(), kMasses.end(), 0.0, [](double sum, const Mass& mass) { return sum + mass.share; });

/// Place of the first point of each segment in the table of points.
std::array<std::size_t, model::kBodySegmentCount> firstPoints() {
    std::array<std::size_t, model::kBodySegmentCount> first{};
    const auto points = model::anatomicalPoints();
    for (std::size_t place = points.size(); place-- > 0;) {
        first[static_cast<std::size_t>(points[place].segment)] = place;
    }
    return first;
}

} // namespace

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

void differentiate(const ThreeMoments& moments, std::span<SegmentState> states) {
    const auto& [before, now, after, step] = moments;
    for (std::size_t index = 0; index < now.size(); ++index) {
        const PointState point =
            differentiated(before[index].position, now[index].position, after[index].position, step);
        const Vector3d first = rotationBetween(before[index].orientation, now[index].orientation) / step;
        const Vector3d second = rotationBetween(now[index].orientation, after[index].orientation) / step;
        states[index] = {now[index], point.velocity, point.acceleration, 0.5 * (first + second),
                         (second - first) / step};
    }
}

Vector3d centreOfMass(const model::ReferenceBody& body, std::span<const model::SegmentPose> segments) {
    static const auto first = firstPoints();
    Vector3d sum = Vector3d::Zero();
    for (std::size_t index = 0; index < kMasses.size(); ++index) {
        const Mass& mass = kMasses[index];
        const Vector3d& far = body.points[first[index] + 1];
        sum += mass.share * (segments[index].position + segments[index].orientation * (mass.centre * far));
    }
    return sum / kTabulatedSum;
}

} // namespace posewire::performer
