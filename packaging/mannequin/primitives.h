// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

/// Signed fields in metres: negative inside, about the distance near the surface.
namespace posewire::render::mannequin {

/// 0 up to `from`, 1 from `to` on, and a cubic in between; `from` may be larger than `to`.
double smoothstep(double from, double to, double x);

/// 0 below, 1 above, over ±width around zero.
double ramp(double width, double x);

/// Minimum and maximum with a polynomial fillet where the arguments differ by less than `radius`.
double smoothUnion(double a, double b, double radius);
double smoothIntersection(double a, double b, double radius);

struct Box {
    glm::dvec3 low{1e9};
    glm::dvec3 high{-1e9};

    void extend(const glm::dvec3& centre, const glm::dvec3& halfSize);
    double distance(const glm::dvec3& point) const;
};

struct Ellipsoid {
    glm::dvec3 centre;
    glm::dvec3 radii;
    /// Turned by `turn.y` about Y, then `turn.x` about X, then `turn.z` about Z, in radians.
    glm::dvec3 turn{0.0};
};

/// A segment thickened by a radius that changes linearly along it.
struct Cone {
    glm::dvec3 from;
    glm::dvec3 to;
    double fromRadius;
    double toRadius;
};

double distance(const Cone& cone, const glm::dvec3& point);
void extend(Box& box, const Cone& cone);

/// An ellipsoid with its axes worked out.
class EllipsoidField {
public:
    explicit EllipsoidField(const Ellipsoid& shape);
    double distance(const glm::dvec3& point) const;
    void extend(Box& box) const;

private:
    glm::dvec3 m_centre;
    glm::dvec3 m_radii;
    glm::dmat3 m_localFromBody;
};

/// One cross-section of a loft: place along the axis, then centre and radii across it (the other axes in x,
/// y, z order).
struct LoftStation {
    double place;
    double centreU;
    double centreV;
    double radiusU;
    double radiusV;
};

enum class Axis { X, Y, Z };

/// Superelliptic cross-sections along an axis, joined by natural cubic splines.
struct LoftShape {
    Axis axis;
    /// In rising order of place.
    std::span<const LoftStation> stations;
    /// 2 is an ellipse, more is squarer.
    double exponent;
    /// Rounding of the two ends.
    double cap;
};

class LoftField {
public:
    explicit LoftField(const LoftShape& shape);
    double distance(const glm::dvec3& point) const;
    void extend(Box& box) const;

private:
    using Columns = std::array<double, 4>;

    Columns sectionAt(double place) const;

    LoftShape m_shape;
    int m_along;
    int m_across;
    int m_upward;
    /// Second derivatives of the four columns at the stations.
    std::vector<Columns> m_bends;
};

} // namespace posewire::render::mannequin
