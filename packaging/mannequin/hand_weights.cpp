// SPDX-License-Identifier: MIT
#include "packaging/mannequin/hand_weights.h"

#include "packaging/mannequin/body_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>

namespace posewire::render::mannequin {
namespace {

/// Over this width around a joint's plane the bones before and after it share the skin, as a part of the
/// digit's radius there.
constexpr double kJointWidth = 0.85;
/// Skin within this of being equally near to two digits is shared: in the palm, and where the digits are
/// free.
constexpr double kPalmWidth = 0.016;
constexpr double kFingerWidth = 0.004;
/// Where the palm ends, along the arm.
constexpr double kWebFrom = 0.770;
constexpr double kWebTo = 0.795;
/// The carpus lies between these.
constexpr double kCarpusFrom = 0.700;
constexpr double kCarpusTo = 0.722;
constexpr double kCarpusWidth = 0.012;

/// The joints of one digit from its metacarpal on, and the tip.
struct Chain {
    std::size_t first;
    std::span<const glm::vec3> joints;
    glm::dvec3 tip;
    std::array<double, 4> radii;

    glm::dvec3 place(std::size_t i) const { return i < joints.size() ? glm::dvec3(joints[i]) : tip; }
    glm::dvec3 direction(std::size_t bone) const { return glm::normalize(place(bone + 1) - place(bone)); }
};

/// The thumb has three segments, the fingers four with their metacarpal, which the palm hides.
Chain chainOf(std::size_t digit) {
    const bool isThumb = digit == 0;
    const std::size_t first = kDigits[digit].firstJoint - (isThumb ? 0U : 1U);
    const std::span<const glm::vec3> joints = std::span(kReferenceHand).subspan(first, isThumb ? 3 : 4);
    return {first, joints, kReferenceFingertips[digit], kDigits[digit].radii};
}

double distanceTo(const Chain& chain, const glm::dvec3& point) {
    double nearest = 1.0;
    for (std::size_t bone = 0; bone < chain.joints.size(); ++bone) {
        nearest =
            std::min(nearest, distance(Cone{chain.place(bone), chain.place(bone + 1), 0.0, 0.0}, point));
    }
    return nearest;
}

/// How much each digit has of a point; the nearest has most.
std::array<double, kDigits.size()> digitShares(const glm::dvec3& point) {
    std::array<double, kDigits.size()> away{};
    for (std::size_t digit = 0; digit < away.size(); ++digit) {
        away[digit] = distanceTo(chainOf(digit), point);
    }
    const double nearest = *std::ranges::min_element(away);
    const double free = smoothstep(kWebFrom, kWebTo, point.y);
    const double width = kPalmWidth + (kFingerWidth - kPalmWidth) * free;
    double sum = 0.0;
    for (double& share : away) {
        const double near = std::max(1.0 - (share - nearest) / width, 0.0);
        share = near * near;
        sum += share;
    }
    for (double& share : away) {
        share /= sum;
    }
    return away;
}

} // namespace

std::array<double, kHandSegmentCount> handShares(const glm::dvec3& point) {
    std::array<double, kHandSegmentCount> shares{};
    const double carpus = ramp(kCarpusWidth, point.y - kCarpusFrom);
    const auto digits = digitShares(point);
    for (std::size_t digit = 0; digit < digits.size(); ++digit) {
        const Chain chain = chainOf(digit);
        const bool isThumb = digit == 0;
        double left = carpus * digits[digit];
        const double metacarpal =
            isThumb ? ramp(kCarpusWidth, glm::dot(point - chain.place(0), chain.direction(0)))
                    : ramp(kCarpusWidth, point.y - kCarpusTo);
        shares[0] += left * (1.0 - metacarpal);
        left *= metacarpal;
        for (std::size_t bone = 0; bone + 1 < chain.joints.size(); ++bone) {
            const glm::dvec3 across = glm::normalize(chain.direction(bone) + chain.direction(bone + 1));
            const double width = kJointWidth * chain.radii[isThumb ? bone + 1 : bone];
            const double beyond = ramp(width, glm::dot(point - chain.place(bone + 1), across));
            shares[chain.first + bone] = left * (1.0 - beyond);
            left *= beyond;
        }
        shares[chain.first + chain.joints.size() - 1] = left;
    }
    return shares;
}

} // namespace posewire::render::mannequin
