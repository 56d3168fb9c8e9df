// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/points.h"

#include <Eigen/Geometry>

#include <array>
#include <span>
#include <string_view>

namespace posewire::model {

inline constexpr int kJointCount = 28; ///< 22 joints and 6 ergonomic angles

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
/// identity elsewhere. Verified on exported files of two MVN versions: at most 0.0009° off.
Eigen::Vector3d jointAngle(const JointDefinition& joint, const Eigen::Quaterniond& parent,
                           const Eigen::Quaterniond& child);

/// O of a body segment, by its place from 0: turns its T-pose frame into its ISB frame.
Eigen::Quaterniond isbFrame(int segment);

/// All rows of type 20 from the orientations of the 23 body segments.
///
/// Which vertical frame the last two rows refer to is not published; here it is the world's, turned about z
/// to the heading of the segment.
/// `orientations` are 23, worldFromSegment, T-pose based; `angles`, 22 or 28, in radians.
void jointAngles(std::span<const Eigen::Quaterniond> orientations, std::span<Eigen::Vector3d> angles);

} // namespace posewire::model
