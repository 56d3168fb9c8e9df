// SPDX-License-Identifier: MIT
#include "packaging/mannequin/body.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace posewire::render::mannequin {
namespace {

/// Beyond this distance from its bounds a part can neither be the surface nor blend with it.
constexpr double kReach = 0.12;
constexpr double kNowhere = 1e3;

double shapeDistance(const EllipsoidField& shape, const glm::dvec3& point) {
    return shape.distance(point);
}
double shapeDistance(const Cone& shape, const glm::dvec3& point) {
    return distance(shape, point);
}

void extendBy(Box& box, const EllipsoidField& shape) {
    shape.extend(box);
}
void extendBy(Box& box, const Cone& shape) {
    extend(box, shape);
}

EllipsoidField fieldOf(const Ellipsoid& shape) {
    return EllipsoidField(shape);
}
Cone fieldOf(const Cone& shape) {
    return shape;
}

} // namespace

Body::Body() {
    m_parts.push_back(makePart(0.050, &kTorso, kTrunkBlends));
    m_parts.push_back(makePart(0.050, nullptr, kNeckBlends));
    m_parts.push_back(makePart(0.026, nullptr, kHeadBlends));
    m_parts.push_back(makePart(0.055, &kArm, kArmBlends));
    m_parts.push_back(makePart(0.022, &kPalm, {}));
    addHand(m_parts.back());
    m_parts.push_back(makePart(0.030, &kLeg, kLegBlends));
    m_parts.push_back(makePart(0.035, &kFoot, kFootBlends));
    m_parts.back().hasSole = true;
}

Body::Part Body::makePart(double blend, const LoftShape* loft, std::span<const Blend> blends) {
    Part part;
    part.blend = blend;
    if (loft != nullptr) {
        part.loft.emplace(*loft);
        part.loft->extend(part.bounds);
    }
    for (const Blend& addition : blends) {
        std::visit(
            [&](const auto& shape) {
                const auto field = fieldOf(shape);
                extendBy(part.bounds, field);
                part.additions.push_back({field, addition.radius, addition.kind});
            },
            addition.shape);
    }
    return part;
}

void Body::addHand(Part& part) {
    for (const Finger& finger : kFingers) {
        const glm::dvec3 root(finger.x, finger.y - 0.012, kShoulderHeight - 0.003);
        const glm::dvec3 proximal = glm::normalize(glm::dvec3(finger.slope, 1.0, -0.10));
        const glm::dvec3 distal = glm::normalize(glm::dvec3(finger.slope * 0.8, 1.0, -0.30));
        const glm::dvec3 knuckle = root + proximal * (0.012 + finger.length * 0.45);
        const glm::dvec3 tip = knuckle + distal * (finger.length * 0.55 - finger.tipRadius);
        const double middleRadius = (finger.rootRadius + finger.tipRadius) / 2.0;
        part.digits.push_back({{root, knuckle, finger.rootRadius, middleRadius},
                               {knuckle, tip, middleRadius, finger.tipRadius},
                               kFingerJointBlend,
                               kFingerBlend});
    }
    part.digits.push_back({kThumb[0], kThumb[1], kThumbJointBlend, kThumbBlend});
    for (const Digit& digit : part.digits) {
        extend(part.bounds, digit.lower);
        extend(part.bounds, digit.upper);
    }
}

double Body::partDistance(const Part& part, const glm::dvec3& point) {
    double d = part.loft ? part.loft->distance(point) : kNowhere;
    for (const Addition& addition : part.additions) {
        const double shape =
            std::visit([&](const auto& field) { return shapeDistance(field, point); }, addition.shape);
        d = addition.kind == Blend::Kind::Add ? smoothUnion(d, shape, addition.radius)
                                              : smoothIntersection(d, -shape, addition.radius);
    }
    for (const Digit& digit : part.digits) {
        const double finger = smoothUnion(mannequin::distance(digit.lower, point),
                                          mannequin::distance(digit.upper, point), digit.jointBlend);
        d = smoothUnion(d, finger, digit.blend);
    }
    return part.hasSole ? smoothIntersection(d, kSoleHeight - point.z, kFootSoleFillet) : d;
}

double Body::distance(const glm::dvec3& point) const {
    const glm::dvec3 left(point.x, std::abs(point.y), point.z);
    double d = kNowhere;
    double away = kNowhere;
    for (const Part& part : m_parts) {
        const double toBounds = part.bounds.distance(left);
        if (toBounds > kReach) {
            away = std::min(away, toBounds);
        } else {
            d = smoothUnion(d, partDistance(part, left), part.blend);
        }
    }
    if (d == kNowhere) {
        return away;
    }
    return smoothIntersection(d, kSoleHeight - point.z, kBodySoleFillet);
}

glm::dvec3 Body::gradient(const glm::dvec3& point, double step) const {
    glm::dvec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 ahead = point;
        glm::dvec3 behind = point;
        ahead[axis] += step;
        behind[axis] -= step;
        slope[axis] = (distance(ahead) - distance(behind)) / (2.0 * step);
    }
    return slope;
}

} // namespace posewire::render::mannequin
