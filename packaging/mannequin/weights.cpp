// SPDX-License-Identifier: MIT
#include "packaging/mannequin/weights.h"

#include "packaging/mannequin/hand_weights.h"
#include "packaging/mannequin/primitives.h"

#include <algorithm>
#include <cmath>

namespace posewire::render::mannequin {
namespace {

constexpr double kShoulderJointHeight = 1.4196;
/// Less than this share is left to the others.
constexpr double kLeastWeight = 0.004;

using Weights = std::array<double, kJointCount>;

/// From a segment on the right to the same on the left.
constexpr std::size_t kLeftAfterRight = 4;

enum class Side { Right, Left };

/// The segment on the given side for one named on the right.
std::size_t onSide(Segment right, Side side) {
    return right + (side == Side::Left ? kLeftAfterRight : 0U);
}

/// The twist joint takes what the segment does not: all of the weight at the near end of the bone, none at
/// the far end.
void shareWithTwist(Weights& weights, Segment right, Side side, double twistShare) {
    const std::size_t segment = onSide(right, side);
    for (std::size_t i = 0; i < kTwistJointCount; ++i) {
        if (kTwistJoints[i].segment == segment) {
            weights[kSegmentCount + i] = weights[segment] * (1.0 - twistShare);
            weights[segment] *= twistShare;
        }
    }
}

/// A limb's claim as shares of the limb and of the half joint between it and the trunk; what is left to 1 is
/// the trunk's.
struct LimbClaim {
    double limb;
    double half;

    explicit LimbClaim(double claim) : limb(claim * claim), half(2.0 * claim * (1.0 - claim)) {}
    double whole() const { return limb + half; }
};

void giveHalf(Weights& weights, Segment right, Side side, double share) {
    const std::size_t segment = onSide(right, side);
    for (std::size_t i = 0; i < kHalfJointCount; ++i) {
        if (kHalfJoints[i] == segment) {
            weights[kFirstHalfJoint + i] = share;
        }
    }
}

/// Shares what the hand has with its fingers.
void shareWithFingers(Weights& weights, Side side, const glm::dvec3& left) {
    double& hand = weights[onSide(RightHand, side)];
    const std::size_t first = kFirstFingerJoint + (side == Side::Left ? 0U : kHandSegmentCount);
    const auto shares = handShares(left);
    double rest = 1.0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        weights[first + i] = hand * shares[i];
        rest -= shares[i];
    }
    hand *= std::max(rest, 0.0);
}

/// Returns what the arm took.
double claimArm(Weights& weights, const glm::dvec3& p, Side side) {
    const double y = std::abs(p.y);
    const bool isMine = side == Side::Left ? p.y > 0.0 : p.y < 0.0;
    if (!isMine) {
        return 0.0;
    }
    const double claim = smoothstep(-0.075, 0.065, 0.95 * (y - 0.168) + 0.40 * (p.z - kShoulderJointHeight)) *
                         smoothstep(0.07, 0.13, y) * smoothstep(1.20, 1.30, p.z) *
                         (1.0 - smoothstep(1.49, 1.53, p.z));
    const LimbClaim shares(claim);
    const double fore = ramp(0.048, y - 0.450);
    const double hand = ramp(0.024, y - 0.685);
    weights[onSide(RightUpperArm, side)] = shares.limb * (1.0 - fore);
    weights[onSide(RightForeArm, side)] = shares.limb * fore * (1.0 - hand);
    weights[onSide(RightHand, side)] = shares.limb * fore * hand;
    shareWithFingers(weights, side, {p.x, y, p.z});
    giveHalf(weights, RightUpperArm, side, shares.half);
    shareWithTwist(weights, RightUpperArm, side, smoothstep(0.165, 0.42, y));
    shareWithTwist(weights, RightForeArm, side, smoothstep(0.45, 0.66, y));
    return shares.whole();
}

/// Returns what the leg took.
double claimLeg(Weights& weights, const glm::dvec3& p, Side side) {
    const double towards = side == Side::Left ? p.y : -p.y;
    // Higher at the side than between the legs, where the skin must reach from one to the other.
    const double aside = std::abs(p.y) - 0.084;
    const double inwards = smoothstep(0.04, -0.06, aside);
    const double slant = 0.25 * p.x + (0.30 + 0.35 * inwards) * aside - 0.90 * (p.z - 0.905);
    const double claim =
        ramp(0.065 + 0.030 * inwards, slant) * ramp(0.020, towards) * (1.0 - smoothstep(1.0, 1.1, p.z));
    const double shank = ramp(0.055, 0.499 - p.z);
    const double foot = ramp(0.026, 0.9 * (0.085 - p.z) + 0.35 * p.x);
    const double toe = ramp(0.024, p.x - 0.148);
    const LimbClaim shares(claim);
    weights[onSide(RightUpperLeg, side)] = shares.limb * (1.0 - shank);
    weights[onSide(RightLowerLeg, side)] = shares.limb * shank * (1.0 - foot);
    weights[onSide(RightFoot, side)] = shares.limb * shank * foot * (1.0 - toe);
    weights[onSide(RightToe, side)] = shares.limb * shank * foot * toe;
    giveHalf(weights, RightUpperLeg, side, shares.half);
    shareWithTwist(weights, RightUpperLeg, side, smoothstep(0.06, 0.36, 0.9275 - p.z));
    return shares.whole();
}

void shareTrunk(Weights& weights, const glm::dvec3& p, double rest) {
    const double y = std::abs(p.y);
    const double neck = ramp(0.042, (p.z - 1.4817) + 0.25 * p.x) *
                        (1.0 - smoothstep(0.045, 0.095, y) * (1.0 - smoothstep(1.53, 1.56, p.z)));
    // Tilted, so that chin and occiput stay with the head.
    const double head = ramp(0.022, (p.z - 1.585) + 0.75 * std::max(p.x, 0.0));
    weights[Head] = rest * neck * head;
    weights[Neck] = rest * neck * (1.0 - head);
    const double shoulder = smoothstep(0.010, 0.120, y) *
                            smoothstep(kShoulderJointHeight - 0.085, kShoulderJointHeight + 0.010, p.z) *
                            (1.0 - neck);
    weights[p.y < 0.0 ? RightShoulder : LeftShoulder] = rest * shoulder;

    struct Border {
        Segment below;
        double height;
        double width;
    };
    constexpr std::array<Border, 4> kBorders{
        {{Pelvis, 1.0275, 0.055}, {L5, 1.1383, 0.050}, {L3, 1.2394, 0.050}, {T12, 1.3404, 0.050}}};
    double left = rest * (1.0 - neck) * (1.0 - shoulder);
    for (const Border& border : kBorders) {
        const double above = ramp(border.width, p.z - border.height);
        weights[border.below] = left * (1.0 - above);
        left *= above;
    }
    weights[T8] = left;
}

Influences largest(const Weights& weights, bool isSymmetric) {
    std::array<std::uint8_t, kJointCount> order;
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = static_cast<std::uint8_t>(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return weights[a] > weights[b]; });
    std::size_t count = 0;
    double sum = 0.0;
    while (count < 4 && weights[order[count]] >= kLeastWeight) {
        sum += weights[order[count++]];
    }
    // In the mirror plane a pair stays or goes together.
    if (isSymmetric && count == 4 && weights[order[4]] == weights[order[3]]) {
        sum -= weights[order[--count]];
    }
    Influences influences;
    for (std::size_t i = 0; i < count; ++i) {
        influences.joints[i] = order[i];
        influences.weights[static_cast<int>(i)] = static_cast<float>(weights[order[i]] / sum);
    }
    return influences;
}

std::uint8_t mirroredJoint(std::uint8_t joint) {
    if (joint >= kFirstFingerJoint) {
        const std::size_t finger = joint - kFirstFingerJoint;
        return static_cast<std::uint8_t>(kFirstFingerJoint +
                                         (finger + kHandSegmentCount) % kFingerJointCount);
    }
    if (joint >= kSegmentCount) {
        // Twist and half joints come in pairs, the right one first.
        const std::size_t pair = joint - kSegmentCount;
        return static_cast<std::uint8_t>(pair < kTwistJointCount
                                             ? kSegmentCount + (pair ^ 1U)
                                             : kFirstHalfJoint + ((pair - kTwistJointCount) ^ 1U));
    }
    if (joint < RightShoulder) {
        return joint;
    }
    const bool isRight = joint < LeftShoulder || (joint >= RightUpperLeg && joint < LeftUpperLeg);
    return static_cast<std::uint8_t>(isRight ? joint + kLeftAfterRight : joint - kLeftAfterRight);
}

} // namespace

Influences influencesAt(const glm::dvec3& point) {
    Weights weights{};
    double rest = 1.0;
    for (const Side side : {Side::Right, Side::Left}) {
        rest -= claimArm(weights, point, side);
        rest -= claimLeg(weights, point, side);
    }
    shareTrunk(weights, point, rest);
    return largest(weights, point.y == 0.0);
}

Influences mirrored(const Influences& influences) {
    Influences other = influences;
    for (std::size_t i = 0; i < other.joints.size(); ++i) {
        const bool isUsed = other.weights[static_cast<int>(i)] > 0.0F;
        other.joints[i] = isUsed ? mirroredJoint(other.joints[i]) : std::uint8_t{0};
    }
    return other;
}

} // namespace posewire::render::mannequin
