// SPDX-License-Identifier: MIT
#include "core/model/body/spaces.h"

#include <algorithm>
#include <cmath>

namespace posewire::model {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d zUpFromYUp(const Vector3d& yUp) {
    return {yUp.z(), yUp.x(), yUp.y()};
}

Vector3d yUpFromZUp(const Vector3d& zUp) {
    return {zUp.y(), zUp.z(), zUp.x()};
}

// A permutation without reflection permutes the axis of a rotation in the same way.
Quaterniond zUpFromYUp(const Quaterniond& yUp) {
    return {yUp.w(), yUp.z(), yUp.x(), yUp.y()};
}

Quaterniond yUpFromZUp(const Quaterniond& zUp) {
    return {zUp.w(), zUp.y(), zUp.z(), zUp.x()};
}

Vector3d zUpFromUnity(const Vector3d& unity) {
    return {unity.z(), -unity.x(), unity.y()};
}

Vector3d unityFromZUp(const Vector3d& zUp) {
    return {-zUp.y(), zUp.z(), zUp.x()};
}

// The mapping reflects, so the axis of a rotation takes the opposite sign of a position.
Quaterniond zUpFromUnity(const Quaterniond& unity) {
    return {unity.w(), -unity.z(), unity.x(), -unity.y()};
}

Quaterniond unityFromZUp(const Quaterniond& zUp) {
    return {zUp.w(), zUp.y(), -zUp.z(), -zUp.x()};
}

Quaterniond quaternionFromEuler(const Vector3d& radians) {
    return Eigen::AngleAxisd(radians.z(), Vector3d::UnitZ()) *
           Eigen::AngleAxisd(radians.y(), Vector3d::UnitY()) *
           Eigen::AngleAxisd(radians.x(), Vector3d::UnitX());
}

Vector3d eulerFromQuaternion(const Quaterniond& orientation) {
    const Eigen::Matrix3d r = orientation.toRotationMatrix();
    const double sine = std::clamp(-r(2, 0), -1.0, 1.0);
    constexpr double kGimbalLock = 1.0 - 1e-12;
    if (std::abs(sine) > kGimbalLock) {
        return {std::atan2(sine * r(0, 1), r(1, 1)), std::asin(sine), 0.0};
    }
    return {std::atan2(r(2, 1), r(2, 2)), std::asin(sine), std::atan2(r(1, 0), r(0, 0))};
}

SegmentPose poseFromEuler(const wire::SegmentEuler& item, LengthUnit unit) {
    const Vector3d radians = toVector(item.rotation) * kRadiansPerDegree;
    return {pointFromYUp(item.position, unit),
            normalizedOrIdentity(zUpFromYUp(quaternionFromEuler(radians)))};
}

wire::SegmentEuler eulerFromPose(const SegmentPose& pose, LengthUnit unit) {
    const Vector3d radians = eulerFromQuaternion(yUpFromZUp(pose.orientation));
    return {0, yUpFromPoint(pose.position, unit), toFloats(Vector3d(radians * kDegreesPerRadian))};
}

SegmentPose poseFromQuaternion(const wire::SegmentQuaternion& item, LengthUnit unit) {
    return {toVector(item.position) * metresPer(unit), normalizedOrIdentity(toQuaternion(item.orientation))};
}

SegmentPose poseFromUnity(const wire::SegmentQuaternion& item, LengthUnit unit) {
    return {zUpFromUnity(Vector3d(toVector(item.position) * metresPer(unit))),
            normalizedOrIdentity(zUpFromUnity(toQuaternion(item.orientation)))};
}

wire::SegmentQuaternion unityFromPose(const SegmentPose& pose) {
    return {0, toFloats(unityFromZUp(pose.position)), toFloats(unityFromZUp(pose.orientation))};
}

Eigen::Quaterniond headingOf(const Eigen::Quaterniond& orientation) {
    const Eigen::Vector3d ahead = orientation * Eigen::Vector3d::UnitX();
    return Eigen::Quaterniond(Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Eigen::Vector3d::UnitZ()));
}

SegmentPose composed(const SegmentPose& parent, const SegmentPose& local) {
    return {parent.position + parent.orientation * local.position, parent.orientation * local.orientation};
}

SegmentPose relativeTo(const SegmentPose& parent, const SegmentPose& world) {
    const Quaterniond parentFromWorld = parent.orientation.conjugate();
    return {parentFromWorld * (world.position - parent.position), parentFromWorld * world.orientation};
}

Vector3d pointFromYUp(const std::array<float, 3>& wire, LengthUnit unit) {
    return zUpFromYUp(Vector3d(toVector(wire) * metresPer(unit)));
}

std::array<float, 3> yUpFromPoint(const Vector3d& point, LengthUnit unit) {
    const double scale = 1.0 / metresPer(unit);
    return toFloats(Vector3d(yUpFromZUp(point) * scale));
}

std::array<float, 3> toFloats(const Vector3d& vector) {
    return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

std::array<float, 4> toFloats(const Quaterniond& orientation) {
    return {static_cast<float>(orientation.w()), static_cast<float>(orientation.x()),
            static_cast<float>(orientation.y()), static_cast<float>(orientation.z())};
}

Vector3d toVector(const std::array<float, 3>& floats) {
    return {floats[0], floats[1], floats[2]};
}

Quaterniond toQuaternion(const std::array<float, 4>& floats) {
    return {floats[0], floats[1], floats[2], floats[3]};
}

bool isPlace(const Eigen::Vector3d& position) {
    constexpr double kFarthest = 1e5;
    return position.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kFarthest;
}

Quaterniond normalizedOrIdentity(const Quaterniond& orientation) {
    constexpr double kShortest = 1e-6;
    const double norm = orientation.norm();
    if (!std::isfinite(norm) || norm < kShortest) {
        return Quaterniond::Identity();
    }
    return Quaterniond(orientation.coeffs() / norm);
}

} // namespace posewire::model
