// SPDX-License-Identifier: MIT
#include "core/model/body/joint_angles.h"

#include "core/model/body/character_pose.h"
#include "core/model/body/item_names.h"
#include "core/model/body/spaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace posewire::model {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using namespace segment;

using Signs = std::array<double, 3>;
constexpr Signs kCentreSigns{1.0, 1.0, 1.0};
constexpr Signs kRightSigns{-1.0, 1.0, -1.0};
constexpr Signs kLeftSigns{1.0, -1.0, -1.0};
constexpr Signs kRightKneeSigns{-1.0, 1.0, 1.0};
constexpr Signs kLeftKneeSigns{1.0, -1.0, 1.0};

constexpr std::array<JointDefinition, kJointCount> kJoints{{
    {"jL5S1", "L5 S1", {1, 2}, {2, 1}, kCentreSigns},
    {"jL4L3", "L4 L3", {2, 2}, {3, 1}, kCentreSigns},
    {"jL1T12", "L1 T12", {3, 2}, {4, 1}, kCentreSigns},
    {"jT9T8", "T9 T8", {4, 2}, {5, 1}, kCentreSigns},
    {"jT1C7", "T1 C7", {5, 2}, {6, 1}, kCentreSigns},
    {"jC1Head", "C1 Head", {6, 2}, {7, 1}, kCentreSigns},
    {"jRightT4Shoulder", "Right T4 Shoulder", {5, 3}, {8, 1}, kRightSigns},
    {"jRightShoulder", "Right Shoulder", {8, 2}, {9, 1}, kRightSigns},
    {"jRightElbow", "Right Elbow", {9, 2}, {10, 1}, kRightSigns},
    {"jRightWrist", "Right Wrist", {10, 2}, {11, 1}, kRightSigns},
    {"jLeftT4Shoulder", "Left T4 Shoulder", {5, 4}, {12, 1}, kLeftSigns},
    {"jLeftShoulder", "Left Shoulder", {12, 2}, {13, 1}, kLeftSigns},
    {"jLeftElbow", "Left Elbow", {13, 2}, {14, 1}, kLeftSigns},
    {"jLeftWrist", "Left Wrist", {14, 2}, {15, 1}, kLeftSigns},
    {"jRightHip", "Right Hip", {1, 3}, {16, 1}, kRightSigns},
    {"jRightKnee", "Right Knee", {16, 2}, {17, 1}, kRightKneeSigns},
    {"jRightAnkle", "Right Ankle", {17, 2}, {18, 1}, kRightSigns},
    {"jRightBallFoot", "Right Ball of Foot", {18, 2}, {19, 1}, kRightSigns},
    {"jLeftHip", "Left Hip", {1, 4}, {20, 1}, kLeftSigns},
    {"jLeftKnee", "Left Knee", {20, 2}, {21, 1}, kLeftKneeSigns},
    {"jLeftAnkle", "Left Ankle", {21, 2}, {22, 1}, kLeftSigns},
    {"jLeftBallFoot", "Left Ball of Foot", {22, 2}, {23, 1}, kLeftSigns},
    {"T8_Head", "T8 to Head", {5, 0}, {7, 0}, kCentreSigns},
    {"T8_LeftUpperArm", "T8 to Left Upper Arm", {5, 0}, {13, 0}, kLeftSigns},
    {"T8_RightUpperArm", "T8 to Right Upper Arm", {5, 0}, {9, 0}, kRightSigns},
    {"Pelvis_T8", "Pelvis to T8", {1, 0}, {5, 0}, kCentreSigns},
    {"Vertical_Pelvis", "Vertical to Pelvis", {1, 0}, {1, 0}, kCentreSigns, true},
    {"Vertical_T8", "Vertical to T8", {1, 0}, {5, 0}, kCentreSigns, true},
}};

constexpr double kPi = std::numbers::pi;

double nearestTurn(double angle, double to) {
    return to + std::remainder(angle - to, 2 * kPi);
}

BodyAngles unknownAngles() {
    BodyAngles angles;
    angles.fill(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    return angles;
}

} // namespace

Quaterniond isbFrame(int segment) {
    constexpr double kHalfRoot = std::numbers::sqrt2 / 2.0;
    switch (segment) {
    case kRightUpperArm:
        return {kHalfRoot, -kHalfRoot, 0.0, 0.0};
    case kLeftUpperArm:
        return {kHalfRoot, kHalfRoot, 0.0, 0.0};
    case kRightForeArm:
    case kRightHand:
        return {0.5, -0.5, 0.5, 0.5};
    case kLeftForeArm:
    case kLeftHand:
        return {0.5, 0.5, 0.5, -0.5};
    default:
        return Quaterniond::Identity();
    }
}

const std::array<JointDefinition, kJointCount>& jointDefinitions() {
    return kJoints;
}

Vector3d jointAngle(const JointDefinition& joint, const Quaterniond& parent, const Quaterniond& child,
                    Stance stance) {
    const auto frameOf = [stance](int segment) {
        return stance == Stance::T ? isbFrame(segment) : Quaterniond::Identity();
    };
    const Quaterniond parentFrame =
        joint.isVertical ? headingOf(child) : Quaterniond(parent * frameOf(joint.parentSegment()));
    const Quaterniond childFrame = child * frameOf(joint.childSegment());
    const Eigen::Matrix3d r = (parentFrame.conjugate() * childFrame).normalized().toRotationMatrix();
    const double abduction = std::asin(std::clamp(-r(1, 2), -1.0, 1.0));
    // At ±90° of abduction all four are rounding errors: flexion then has what is known of the two.
    constexpr double kLocked = 1e-7;
    const bool isLocked = std::hypot(r(0, 2), r(2, 2)) < kLocked;
    const double flexion = isLocked ? std::atan2(std::copysign(1.0, abduction) * r(0, 1), r(0, 0))
                                    : std::atan2(r(0, 2), r(2, 2));
    const double axial = isLocked ? 0.0 : std::atan2(r(1, 0), r(1, 1));
    return {joint.signs[0] * abduction, joint.signs[1] * axial, joint.signs[2] * flexion};
}

Quaterniond jointTurn(const JointDefinition& joint, const Vector3d& angles) {
    return Eigen::AngleAxisd(joint.signs[2] * angles.z(), Vector3d::UnitY()) *
           Eigen::AngleAxisd(joint.signs[0] * angles.x(), Vector3d::UnitX()) *
           Eigen::AngleAxisd(joint.signs[1] * angles.y(), Vector3d::UnitZ());
}

double jointDifference(const JointDefinition& joint, const Vector3d& one, const Vector3d& other) {
    return jointTurn(joint, one).angularDistance(jointTurn(joint, other));
}

bool isNearGimbalLock(const Vector3d& angles) {
    constexpr double kNear = 5.0 * kRadiansPerDegree;
    return std::abs(std::remainder(angles.x() - kPi / 2, kPi)) < kNear;
}

std::array<Vector3d, 2> equalForms(const Vector3d& angles) {
    return {angles, {kPi - angles.x(), angles.y() + kPi, angles.z() + kPi}};
}

Vector3d closestAngles(const JointDefinition& joint, const Vector3d& angles, const Vector3d& before) {
    constexpr double kLocked = 0.1 * kRadiansPerDegree;
    std::array<Vector3d, 2> forms = equalForms(angles);
    for (Vector3d& form : forms) {
        form = form.binaryExpr(before, &nearestTurn);
    }
    const Vector3d& given = forms[0];
    if (std::abs(std::remainder(given.x() - kPi / 2, kPi)) < kLocked) {
        // Rx(±90°) takes the axis of flexion to that of rotation: rotation ∓ flexion is all that counts.
        const double sense =
            (std::sin(given.x()) > 0 ? -1 : 1) * joint.signs[0] * joint.signs[1] * joint.signs[2];
        const double move =
            std::remainder(given.y() - before.y() + sense * (given.z() - before.z()), 2 * kPi) / 2;
        return {given.x(), before.y() + move, before.z() + sense * move};
    }
    return (forms[1] - before).squaredNorm() < (given - before).squaredNorm() ? forms[1] : given;
}

Stance stanceOf(std::span<const Vector3d> origins) {
    const Vector3d arm = origins[kRightForeArm] - origins[kRightUpperArm];
    return -arm.z() > arm.head<2>().norm() ? Stance::N : Stance::T;
}

void jointAngles(std::span<const Quaterniond> orientations, std::span<Vector3d> angles, Stance stance) {
    for (std::size_t row = 0; row < angles.size(); ++row) {
        const JointDefinition& joint = kJoints[row];
        angles[row] = jointAngle(joint, orientations[static_cast<std::size_t>(joint.parentSegment())],
                                 orientations[static_cast<std::size_t>(joint.childSegment())], stance);
    }
}

BodyAngles anglesOf(const CharacterPose& pose, Stance stance) {
    BodyAngles angles = unknownAngles();
    for (std::size_t row = 0; row < angles.size() && !pose.isObjects; ++row) {
        const auto parent = static_cast<std::size_t>(kJoints[row].parentSegment());
        const auto child = static_cast<std::size_t>(kJoints[row].childSegment());
        const auto isKnown = [&pose](std::size_t segment) {
            return segment < pose.sources.size() && pose.sources[segment].orientation != Provenance::None;
        };
        if (isKnown(parent) && isKnown(child)) {
            angles[row] = jointAngle(kJoints[row], pose.segments[parent].orientation,
                                     pose.segments[child].orientation, stance);
        }
    }
    return angles;
}

BodyAngles anglesOf(const wire::JointAngles& message) {
    BodyAngles angles = unknownAngles();
    for (const wire::Joint& joint : message.joints) {
        const auto row = findJoint(joint.parent, joint.child);
        if (row && *row < kBodyJointCount) {
            angles[static_cast<std::size_t>(*row)] = toVector(joint.rotation) * kRadiansPerDegree;
        }
    }
    return angles;
}

} // namespace posewire::model
