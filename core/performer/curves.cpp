// SPDX-License-Identifier: MIT
#include "core/performer/curves.h"

#include <numbers>

namespace posewire::performer {
namespace {

/// x = a cos u / (1 + sin² u), y = x sin u; ds/du = a / sqrt(1 + sin² u).
double speedOver(double halfWidth, double u) {
    const double s = std::sin(u);
    return halfWidth / std::sqrt(1.0 + s * s);
}

/// Arc length from u = -pi/2 (the crossing) at equal steps of u, by Simpson's rule.
std::vector<double> arcLengths(double halfWidth, std::size_t steps) {
    const double du = 2.0 * std::numbers::pi / static_cast<double>(steps);
    std::vector<double> lengths(steps + 1, 0.0);
    for (std::size_t step = 0; step < steps; ++step) {
        const double u = -0.5 * std::numbers::pi + du * static_cast<double>(step);
        const double middle = speedOver(halfWidth, u + 0.5 * du);
        lengths[step + 1] =
            lengths[step] +
            du / 6.0 * (speedOver(halfWidth, u) + 4.0 * middle + speedOver(halfWidth, u + du));
    }
    return lengths;
}

Eigen::Vector4d placeAt(double halfWidth, double u) {
    const double s = std::sin(u);
    const double c = std::cos(u);
    const double d = 1.0 + s * s;
    // The derivatives of x and y, both times d².
    const double dx = -s * (d + 2.0 * c * c);
    const double dy = c * c * d - s * s * d - 2.0 * s * s * c * c;
    // The curvature of a lemniscate is 3 r / a², and r = a |cos u| / sqrt(d); it changes sign at the
    // crossing.
    const double curvature = 3.0 * c / std::sqrt(d) / halfWidth;
    return {halfWidth * c / d, halfWidth * s * c / d, std::atan2(dy, dx), curvature};
}

} // namespace

FigureOfEight::FigureOfEight(double halfWidth, const Eigen::Vector2d& centre) {
    constexpr std::size_t kSteps = 2048;
    constexpr std::size_t kSamples = 512;
    const std::vector<double> lengths = arcLengths(halfWidth, kSteps);
    m_length = lengths.back();
    const double du = 2.0 * std::numbers::pi / static_cast<double>(kSteps);
    std::vector<Eigen::Vector4d> places;
    places.reserve(kSamples);
    std::size_t step = 0;
    for (std::size_t sample = 0; sample < kSamples; ++sample) {
        const double wanted = m_length * static_cast<double>(sample) / static_cast<double>(kSamples);
        while (lengths[step + 1] < wanted) {
            ++step;
        }
        const double share = (wanted - lengths[step]) / (lengths[step + 1] - lengths[step]);
        Eigen::Vector4d place =
            placeAt(halfWidth, -0.5 * std::numbers::pi + du * (static_cast<double>(step) + share));
        place.head<2>() += centre;
        if (!places.empty()) {
            place[2] +=
                2.0 * std::numbers::pi * std::round((places.back()[2] - place[2]) / (2.0 * std::numbers::pi));
        }
        places.push_back(place);
    }
    // An eight turns as much to the left as to the right, so the heading closes on itself as well.
    m_places = PeriodicSpline<Eigen::Vector4d>(std::move(places));
}

PathPlace FigureOfEight::at(double distance) const {
    const Eigen::Vector4d place = m_places.at(distance / m_length);
    return {place.head<2>(), place[2], place[3]};
}

} // namespace posewire::performer
