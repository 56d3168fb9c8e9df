// SPDX-License-Identifier: MIT
#include "packaging/mannequin/primitives.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace posewire::render::mannequin {
namespace {

glm::dmat3 turnAbout(double angle, const glm::dvec3& axis) {
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, axis));
}

std::array<double, 4> columnsOf(const LoftStation& station) {
    return {station.centreU, station.centreV, station.radiusU, station.radiusV};
}

} // namespace

double smoothstep(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

double ramp(double width, double x) {
    return smoothstep(-width, width, x);
}

double smoothUnion(double a, double b, double radius) {
    const double h = std::max(radius - std::abs(a - b), 0.0) / radius;
    return std::min(a, b) - h * h * radius * 0.25;
}

double smoothIntersection(double a, double b, double radius) {
    return -smoothUnion(-a, -b, radius);
}

void Box::extend(const glm::dvec3& centre, const glm::dvec3& halfSize) {
    low = glm::min(low, centre - halfSize);
    high = glm::max(high, centre + halfSize);
}

double Box::distance(const glm::dvec3& point) const {
    return glm::length(glm::max(glm::max(low - point, point - high), glm::dvec3(0.0)));
}

double distance(const Cone& cone, const glm::dvec3& point) {
    const glm::dvec3 axis = cone.to - cone.from;
    const glm::dvec3 offset = point - cone.from;
    const double t = std::clamp(glm::dot(offset, axis) / glm::dot(axis, axis), 0.0, 1.0);
    return glm::length(offset - t * axis) - (cone.fromRadius + (cone.toRadius - cone.fromRadius) * t);
}

void extend(Box& box, const Cone& cone) {
    box.extend(cone.from, glm::dvec3(cone.fromRadius));
    box.extend(cone.to, glm::dvec3(cone.toRadius));
}

EllipsoidField::EllipsoidField(const Ellipsoid& shape) : m_centre(shape.centre), m_radii(shape.radii) {
    const glm::dmat3 bodyFromLocal = turnAbout(shape.turn.z, {0.0, 0.0, 1.0}) *
                                     turnAbout(shape.turn.x, {1.0, 0.0, 0.0}) *
                                     turnAbout(shape.turn.y, {0.0, 1.0, 0.0});
    m_localFromBody = glm::transpose(bodyFromLocal);
}

double EllipsoidField::distance(const glm::dvec3& point) const {
    const glm::dvec3 local = m_localFromBody * (point - m_centre);
    const double scaled = glm::length(local / m_radii);
    const double slope = glm::length(local / (m_radii * m_radii));
    if (slope <= 1e-9) {
        return -std::min({m_radii.x, m_radii.y, m_radii.z});
    }
    return scaled * (scaled - 1.0) / slope;
}

void EllipsoidField::extend(Box& box) const {
    box.extend(m_centre, glm::dvec3(std::max({m_radii.x, m_radii.y, m_radii.z})));
}

LoftField::LoftField(const LoftShape& shape)
    : m_shape(shape),
      m_along(static_cast<int>(shape.axis)),
      m_across(shape.axis == Axis::X ? 1 : 0),
      m_upward(shape.axis == Axis::Z ? 1 : 2),
      m_bends(shape.stations.size(), Columns{}) {
    // A natural spline: the bends solve a tridiagonal system and vanish at both ends.
    const auto& stations = shape.stations;
    const std::size_t count = stations.size();
    std::vector<double> upper(count, 0.0);
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double before = stations[i].place - stations[i - 1].place;
        const double after = stations[i + 1].place - stations[i].place;
        const double pivot = 2.0 * (before + after) - before * upper[i - 1];
        upper[i] = after / pivot;
        const Columns previous = columnsOf(stations[i - 1]);
        const Columns here = columnsOf(stations[i]);
        const Columns next = columnsOf(stations[i + 1]);
        for (std::size_t c = 0; c < here.size(); ++c) {
            const double jump = (next[c] - here[c]) / after - (here[c] - previous[c]) / before;
            m_bends[i][c] = (6.0 * jump - before * m_bends[i - 1][c]) / pivot;
        }
    }
    for (std::size_t i = count - 1; i-- > 1;) {
        for (std::size_t c = 0; c < m_bends[i].size(); ++c) {
            m_bends[i][c] -= upper[i] * m_bends[i + 1][c];
        }
    }
}

LoftField::Columns LoftField::sectionAt(double place) const {
    const auto& stations = m_shape.stations;
    std::size_t i = 0;
    while (i + 2 < stations.size() && place > stations[i + 1].place) {
        ++i;
    }
    const double width = stations[i + 1].place - stations[i].place;
    const double b = (place - stations[i].place) / width;
    const double a = 1.0 - b;
    const double bendLow = (a * a * a - a) * width * width / 6.0;
    const double bendHigh = (b * b * b - b) * width * width / 6.0;
    const Columns low = columnsOf(stations[i]);
    const Columns high = columnsOf(stations[i + 1]);
    Columns section;
    for (std::size_t c = 0; c < section.size(); ++c) {
        section[c] = a * low[c] + b * high[c] + bendLow * m_bends[i][c] + bendHigh * m_bends[i + 1][c];
    }
    return section;
}

double LoftField::distance(const glm::dvec3& point) const {
    const double first = m_shape.stations.front().place;
    const double last = m_shape.stations.back().place;
    const double place = point[m_along];
    const Columns section = sectionAt(std::clamp(place, first, last));
    const double u = point[m_across] - section[0];
    const double v = point[m_upward] - section[1];
    const double radiusU = std::max(section[2], 1e-3);
    const double radiusV = std::max(section[3], 1e-3);
    const double a = std::abs(u) / radiusU;
    const double b = std::abs(v) / radiusV;
    const double n = m_shape.exponent;
    const double scaled =
        n == 2.0 ? std::sqrt(a * a + b * b) : std::pow(std::pow(a, n) + std::pow(b, n), 1.0 / n);
    const double slope = std::sqrt(a * a / (radiusU * radiusU) + b * b / (radiusV * radiusV));
    const double size = slope > 1e-6 ? std::sqrt(a * a + b * b) / slope : std::min(radiusU, radiusV);
    const double across = (scaled - 1.0) * size;
    const double beyond = std::max(first - place, place - last) + m_shape.cap;
    if (beyond <= 0.0) {
        return across;
    }
    const double inner = across + m_shape.cap;
    return glm::length(glm::dvec2(std::max(inner, 0.0), beyond)) + std::min(std::max(inner, beyond), 0.0) -
           m_shape.cap;
}

void LoftField::extend(Box& box) const {
    for (const LoftStation& station : m_shape.stations) {
        glm::dvec3 centre;
        centre[m_along] = station.place;
        centre[m_across] = station.centreU;
        centre[m_upward] = station.centreV;
        box.extend(centre, glm::dvec3(std::max(station.radiusU, station.radiusV)));
    }
}

} // namespace posewire::render::mannequin
