// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/units.h"
#include "core/model/body/up_axis.h"
#include "core/wire/messages.h"

#include <Eigen/Geometry>

#include <array>

/// Every change of space and unit between the wire and the rest of the program.
///
/// Above the wire there is one frame: Z up, right-handed, X forward in the null pose, metres, seconds,
/// radians, quaternions w x y z that turn segment coordinates into world coordinates.
///
/// Senders: the pairing of type 01 and type 02 was verified on a recording that holds both for the same
/// sample (largest difference of a position 1e-5 cm, of a matrix element 1e-6). The Unity mapping is that of
/// the vendor's own Unity plug-in for type 02.
namespace posewire::model {

/// Where a segment is: `position` of its origin in the world, `orientation` = worldFromSegment.
struct SegmentPose {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

// Y-up right-handed (types 01, 03, 04): a cyclic permutation, X_y = Y_z, Y_y = Z_z, Z_y = X_z.
Eigen::Vector3d zUpFromYUp(const Eigen::Vector3d& yUp);
Eigen::Vector3d yUpFromZUp(const Eigen::Vector3d& zUp);
Eigen::Quaterniond zUpFromYUp(const Eigen::Quaterniond& yUp);
Eigen::Quaterniond yUpFromZUp(const Eigen::Quaterniond& zUp);

// Y-up left-handed (type 05): position (-y, z, x), quaternion (w; y, -z, -x).
Eigen::Vector3d zUpFromUnity(const Eigen::Vector3d& unity);
Eigen::Vector3d unityFromZUp(const Eigen::Vector3d& zUp);
Eigen::Quaterniond zUpFromUnity(const Eigen::Quaterniond& unity);
Eigen::Quaterniond unityFromZUp(const Eigen::Quaterniond& zUp);

/// Fixed-axis XYZ, as type 01: R = Rz(z)·Ry(y)·Rx(x), in radians, in whichever frame the angles live.
Eigen::Quaterniond quaternionFromEuler(const Eigen::Vector3d& radians);
/// The inverse: x and z in (-pi, pi], y in [-pi/2, pi/2]. At y = ±pi/2 x carries the whole turn and z is 0.
Eigen::Vector3d eulerFromQuaternion(const Eigen::Quaterniond& orientation);

// Items of types 01, 02 and 05 as sent; those that are made have no ID.
SegmentPose poseFromEuler(const wire::SegmentEuler& item, LengthUnit unit = LengthUnit::Centimetre);
wire::SegmentEuler eulerFromPose(const SegmentPose& pose, LengthUnit unit = LengthUnit::Centimetre);
/// A quaternion that cannot be normalized (zero, NaN) becomes the identity.
SegmentPose poseFromQuaternion(const wire::SegmentQuaternion& item, LengthUnit unit = LengthUnit::Metre);
/// Type 05: the pelvis in the world, every other segment relative to its parent.
SegmentPose poseFromUnity(const wire::SegmentQuaternion& item, LengthUnit unit = LengthUnit::Metre);
wire::SegmentQuaternion unityFromPose(const SegmentPose& pose);

/// Which way something faces that looks along its x-axis: the turn about the vertical alone.
Eigen::Quaterniond headingOf(const Eigen::Quaterniond& orientation);

/// `parent` o `local`, and back: a pose relative to the parent's frame.
SegmentPose composed(const SegmentPose& parent, const SegmentPose& local);
SegmentPose relativeTo(const SegmentPose& parent, const SegmentPose& world);

/// Points of types 03 and 04: Y-up, wire unit.
Eigen::Vector3d pointFromYUp(const std::array<float, 3>& wire, LengthUnit unit = LengthUnit::Centimetre);
std::array<float, 3> yUpFromPoint(const Eigen::Vector3d& point, LengthUnit unit = LengthUnit::Centimetre);

// Plain copies between the wire's floats and Eigen, no change of space.
std::array<float, 3> toFloats(const Eigen::Vector3d& vector);
std::array<float, 4> toFloats(const Eigen::Quaterniond& orientation);
Eigen::Vector3d toVector(const std::array<float, 3>& floats);
Eigen::Quaterniond toQuaternion(const std::array<float, 4>& floats);

/// Whether it is where somebody can be, in metres: numbers, and within 100 km of the origin. What a corrupt
/// datagram holds mostly is not.
[[nodiscard]] bool isPlace(const Eigen::Vector3d& position);

/// Normalized; the identity where that is impossible.
Eigen::Quaterniond normalizedOrIdentity(const Eigen::Quaterniond& orientation);

} // namespace posewire::model
