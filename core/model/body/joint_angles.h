// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/points.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace posewire::wire {
struct JointAngles;
}

namespace posewire::model {

struct CharacterPose;

inline constexpr int kBodyJointCount = 22;
inline constexpr int kJointCount = 28; ///< 22 joints and 6 ergonomic angles

/// How a body stands with no segment turned: with the arms out, as all streams and newer files have it, or
/// hanging, as MVNX files of version 3 do. With arms that hang, segments have their ISB frames.
enum class Stance : std::uint8_t { T, N };

/// A row of type 20. The place in the datagram tells rows apart: two ergonomic angles carry the same pair of
/// IDs.
struct JointDefinition {
    std::string_view name;        ///< "jRightKnee"
    std::string_view displayName; ///< "Right Knee"
    PointReference parent;        ///< point 0 is the segment itself (ergonomic angles)
    PointReference child;
    std::array<double, 3> signs{1.0, 1.0, 1.0}; ///< of abduction, axial rotation, flexion
    bool isVertical = false;                    ///< the parent is the vertical, turned to the child's heading

    int parentSegment() const { return parent.segmentId - 1; }
    int childSegment() const { return child.segmentId - 1; }
};

/// The 22 joints and 6 ergonomic angles in the order of type 20 (same table in two independent recordings).
const std::array<JointDefinition, kJointCount>& jointDefinitions();

/// x abduction/adduction, y axial rotation, z flexion/extension of `child` against `parent`, in radians:
/// q = conj(q_parent · O_parent) · (q_child · O_child), decomposed as Ry(b) · Rx(a) · Rz(c); x = a, y = c, z
/// = b, each with the joint's sign. O turns the T-pose frame of an arm segment into its ISB frame and is the
/// identity elsewhere, and in stance N. x is from -90° to 90°. Agrees with what MVN 2018 and MVN 4.2 wrote
/// beside their orientations within 0.0002° and 0.03°, as far as the digits in these files allow.
Eigen::Vector3d jointAngle(const JointDefinition& joint, const Eigen::Quaterniond& parent,
                           const Eigen::Quaterniond& child, Stance stance = Stance::T);

/// The turn that jointAngle() takes apart.
Eigen::Quaterniond jointTurn(const JointDefinition& joint, const Eigen::Vector3d& angles);
/// Radians of the one turn between what two triples mean: triples of different numbers may mean the same.
double jointDifference(const JointDefinition& joint, const Eigen::Vector3d& one,
                       const Eigen::Vector3d& other);

/// True within 5° of ±90° of abduction: there small turns change flexion and rotation by large angles, and
/// at 90° only their sum or difference is fixed.
bool isNearGimbalLock(const Eigen::Vector3d& angles);
/// Both forms in which three angles mean the same turn: as given, and with the abduction beyond ±90°.
std::array<Eigen::Vector3d, 2> equalForms(const Eigen::Vector3d& angles);
/// The form that is closest to `before`, each angle by whole turns too. Within 0.1° of the gimbal lock the
/// turn is shared out between flexion and rotation so that they move as little as possible.
Eigen::Vector3d closestAngles(const JointDefinition& joint, const Eigen::Vector3d& angles,
                              const Eigen::Vector3d& before);

/// O of a body segment in stance T, by its place from 0: turns its T-pose frame into its ISB frame.
Eigen::Quaterniond isbFrame(int segment);

/// From the origins of the 23 body segments with none turned, as BodyOrigins has them.
Stance stanceOf(std::span<const Eigen::Vector3d> origins);

/// All rows of type 20 from the orientations of the 23 body segments.
///
/// Which vertical frame the last two rows refer to is not published; here it is the world's, turned about z
/// to the heading of the segment.
/// `orientations` are 23, worldFromSegment; `angles`, 22 or 28, in radians.
void jointAngles(std::span<const Eigen::Quaterniond> orientations, std::span<Eigen::Vector3d> angles,
                 Stance stance = Stance::T);

/// Radians of the 22 joints, NaN for those that are not known.
using BodyAngles = std::array<Eigen::Vector3d, kBodyJointCount>;
/// A joint is known if both its segments have an orientation.
BodyAngles anglesOf(const CharacterPose& pose, Stance stance);
/// As sent in type 20: joints by the points of their ends, in whatever order.
BodyAngles anglesOf(const wire::JointAngles& message);

} // namespace posewire::model
