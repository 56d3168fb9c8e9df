// SPDX-License-Identifier: MIT
#include "packaging/mannequin/body.h"

#include "render/mesh/joints.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace posewire::render::mannequin {
namespace {

/// Beyond this distance from its bounds a part can neither be the surface nor blend with it.
constexpr double kReach = 0.12;
constexpr double kNowhere = 1e3;
constexpr double kFingerJointBlend = 0.002;

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
    m_parts.push_back(makePart(0.005, &kCollar, {}));
    m_parts.push_back(makePart(0.026, nullptr, kHeadBlends));
    m_parts.push_back(makePart(0.055, &kArm, kArmBlends));
    m_parts.push_back(makePart(0.022, &kPalm, {}));
    addHand(m_parts.back());
    m_parts.push_back(makePart(0.030, &kLeg, kLegBlends));
    m_parts.push_back(makePart(0.035, &kFoot, kFootBlends));
    m_parts.back().hasSole = true;
    m_parts.push_back(makePart(0.016, &kSole, {}));
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
    for (std::size_t digit = 0; digit < kDigits.size(); ++digit) {
        const auto& [first, radii, blend] = kDigits[digit];
        std::array<glm::dvec3, 4> places{kReferenceHand[first], kReferenceHand[first + 1],
                                         kReferenceHand[first + 2], kReferenceFingertips[digit]};
        places[3] -= radii[3] * glm::normalize(places[3] - places[2]);
        Finger finger{{}, blend};
        for (std::size_t bone = 0; bone < finger.bones.size(); ++bone) {
            finger.bones[bone] = {places[bone], places[bone + 1], radii[bone], radii[bone + 1]};
            extend(part.bounds, finger.bones[bone]);
        }
        part.fingers.push_back(finger);
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
    for (const Finger& finger : part.fingers) {
        double bones = kNowhere;
        for (const Cone& bone : finger.bones) {
            bones = smoothUnion(bones, mannequin::distance(bone, point), kFingerJointBlend);
        }
        d = smoothUnion(d, bones, finger.blend);
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
