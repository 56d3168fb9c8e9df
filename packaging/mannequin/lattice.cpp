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
/// Shoes end in tight curves: cells are finer there along and across, too.
double shoeScale(double z) {
    return 1.0 - 0.18 * (1.0 - smoothstep(0.05, 0.14, z));
}

/// Cells at the mirror plane must be narrower than the gap between the thighs.
constexpr double kWidestMiddleCell = 0.008;
constexpr double kMiddleWidth = 0.10;

double middleScale(double y, double step) {
    const double narrowest = std::min(1.0, kWidestMiddleCell / step);
    return narrowest + (1.0 - narrowest) * smoothstep(0.0, kMiddleWidth, y);
}

/// Cells below this, which hold the edge of the sole, are half as high.
constexpr double kSoleCells = 0.045;

std::vector<double> halvedAtTheSole(const std::vector<double>& places) {
    std::vector<double> halved{places.front()};
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i] < kSoleCells) {
            halved.push_back((places[i - 1] + places[i]) / 2.0);
        }
        halved.push_back(places[i]);
    }
    return halved;
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

// Head and shoes contract x: without the generous range in x they would stick out of the grid.
Lattice::Lattice(double step) : m_x(ticks(-0.26, 0.33, step, [](double) { return 1.0; })) {
    const double middle = std::min(step, kWidestMiddleCell) / 2.0;
    m_y = ticks(middle, 0.90, step, [&](double y) { return handScale(y) * middleScale(y, step); });
    m_y.insert(m_y.begin(), -middle);
    m_z = halvedAtTheSole(ticks(-0.03, 1.77, step, [](double z) { return headScale(z) * footScale(z); }));
}

glm::dvec3 Lattice::node(std::size_t i, std::size_t j, std::size_t k) const {
    const double y = m_y[j];
    const double z = m_z[k];
    const double hand = handScale(std::abs(y));
    // The arms, as high as the neck, keep their width.
    const double head = headScale(z) + (1.0 - headScale(z)) * smoothstep(0.16, 0.40, std::abs(y));
    const double shoe = shoeScale(z);
    return {m_x[i] * hand * head * shoe, y * head * shoe, kShoulderHeight + (z - kShoulderHeight) * hand};
}

} // namespace posewire::render::mannequin
