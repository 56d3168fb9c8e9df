// SPDX-License-Identifier: MIT
#include "core/performer/centre_of_mass.h"

namespace posewire::performer {
namespace {

using Eigen::Vector3d;

struct Mass {
    double share;  ///< as tabulated; head, trunk and limbs together make 1.0 but for rounding
    int farPoint;  ///< local ID of the point that the segment reaches to
    double centre; ///< share of the way to it; the rib cage reaches far below the joint at which T8 begins
};

constexpr std::array<Mass, model::kBodySegmentCount> kMasses{{
    {0.142, 2, 0.5},                                                             // pelvis
    {0.046, 2, 0.5},   {0.046, 2, 0.5},    {0.047, 2, 0.5},                      // L5, L3, T12
    {0.160, 2, -0.3},  {0.020, 2, 0.5},    {0.061, 2, 0.5},                      // T8, neck, head
    {0.028, 2, 0.5},   {0.028, 2, 0.436},  {0.016, 2, 0.430}, {0.006, 2, 0.506}, // right arm
    {0.028, 2, 0.5},   {0.028, 2, 0.436},  {0.016, 2, 0.430}, {0.006, 2, 0.506}, // left arm
    {0.100, 2, 0.433}, {0.0465, 2, 0.433}, {0.0115, 2, 0.5},  {0.003, 2, 0.5},   // right leg
    {0.100, 2, 0.433}, {0.0465, 2, 0.433}, {0.0115, 2, 0.5},  {0.003, 2, 0.5},   // left leg
}};

constexpr double tabulatedSum() {
    double sum = 0.0;
    for (const Mass& mass : kMasses) {
        sum += mass.share;
    }
    return sum;
}

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

double massShare(int segment) {
    return kMasses[static_cast<std::size_t>(segment)].share / tabulatedSum();
}

Vector3d centreOfMass(const model::ReferenceBody& body, std::span<const model::SegmentPose> segments) {
    static const auto first = firstPoints();
    Vector3d sum = Vector3d::Zero();
    for (std::size_t index = 0; index < kMasses.size(); ++index) {
        const Mass& mass = kMasses[index];
        const Vector3d& far = body.points[first[index] + static_cast<std::size_t>(mass.farPoint - 1)];
        sum += mass.share * (segments[index].position + segments[index].orientation * (mass.centre * far));
    }
    return sum / tabulatedSum();
}

} // namespace posewire::performer
