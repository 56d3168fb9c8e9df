// SPDX-License-Identifier: MIT
#include "packaging/mannequin/lattice.h"

#include "packaging/mannequin/body_tables.h"

#include <algorithm>

namespace posewire::render::mannequin {
namespace {

double handScale(double y) {
    return 1.0 - 0.66 * smoothstep(0.50, 0.69, y);
}
double headScale(double z) {
    return 1.0 - 0.50 * smoothstep(1.45, 1.56, z);
}
double footScale(double z) {
    return 1.0 - 0.25 * (1.0 - smoothstep(0.06, 0.16, z));
}

/// Cells at the mirror plane must be narrower than the gap between the thighs.
constexpr double kWidestMiddleCell = 0.008;
constexpr double kMiddleWidth = 0.10;

double middleScale(double y, double step) {
    const double narrowest = std::min(1.0, kWidestMiddleCell / step);
    return narrowest + (1.0 - narrowest) * smoothstep(0.0, kMiddleWidth, y);
}

template <typename Scale>
std::vector<double> ticks(double from, double to, double step, Scale scale) {
    std::vector<double> places{from};
    while (places.back() < to) {
        places.push_back(places.back() + step * scale(places.back()));
    }
    return places;
}

} // namespace

// The head contracts x to half: without the generous range in x the skull would stick out of the grid.
Lattice::Lattice(double step) : m_x(ticks(-0.26, 0.30, step, [](double) { return 1.0; })) {
    const double middle = std::min(step, kWidestMiddleCell) / 2.0;
    m_y = ticks(middle, 0.90, step, [&](double y) { return handScale(y) * middleScale(y, step); });
    m_y.insert(m_y.begin(), -middle);
    m_z = ticks(-0.03, 1.77, step, [](double z) { return headScale(z) * footScale(z); });
}

glm::dvec3 Lattice::node(std::size_t i, std::size_t j, std::size_t k) const {
    const double y = m_y[j];
    const double z = m_z[k];
    const double hand = handScale(std::abs(y));
    // The arms, as high as the neck, keep their width.
    const double head = headScale(z) + (1.0 - headScale(z)) * smoothstep(0.16, 0.40, std::abs(y));
    return {m_x[i] * hand * head, y * head, kShoulderHeight + (z - kShoulderHeight) * hand};
}

} // namespace posewire::render::mannequin
