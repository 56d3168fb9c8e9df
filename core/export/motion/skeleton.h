// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_reader.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <string_view>
#include <vector>

namespace posewire::exporting {

/// A segment as animation files have it: with its place from its parent.
struct SkeletonJoint {
    std::string_view name;                            ///< "RightUpperArm"
    int position = 0;                                 ///< in the layout
    int parent = -1;                                  ///< its place in the skeleton; -1: free in space
    Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< from the parent's origin in the null pose
    std::vector<std::size_t> children;
};

/// The segments of a character, each before its children and next to them. Metres and Z up, as everywhere.
struct Skeleton {
    model::SegmentLayout layout;
    std::vector<SkeletonJoint> joints;
};

/// Body and fingers; props where `hasProps`. Offsets are those of the null pose, or where there is none those
/// of the first sample, or where that lacks a segment the reference body's.
[[nodiscard]] Skeleton skeletonOf(const feed::PoseCharacter& character, const CharacterSurvey& survey,
                                  bool hasProps);

/// Where the body ends beyond its last joint, from that joint's origin in the null pose: the top of the head,
/// the tips of hands, feet and fingers.
[[nodiscard]] Eigen::Vector3d endOf(const SkeletonJoint& joint, const feed::PoseCharacter& character);

/// Turns poses into those of each joint relative to its parent. What a sample lacks stays as it was.
class JointMotion {
public:
    explicit JointMotion(const Skeleton& skeleton);

    void set(const model::CharacterPose& pose);
    /// Z-up; of the newest sample, in the order of the skeleton. Before the first it is the null pose.
    [[nodiscard]] const std::vector<model::SegmentPose>& local() const { return m_local; }
    /// The same in the world.
    [[nodiscard]] const std::vector<model::SegmentPose>& world() const { return m_world; }

private:
    const Skeleton* m_skeleton;
    std::vector<model::SegmentPose> m_local;
    std::vector<model::SegmentPose> m_world;
};

/// The pose of a segment, by its position in another layout; null if the sample lacks it.
[[nodiscard]] const model::SegmentPose* poseAt(const model::CharacterPose& pose,
                                               const model::SegmentLayout& layout, int position);

/// Where it comes from, the weaker of position and orientation; None if the sample lacks it.
[[nodiscard]] model::Provenance provenanceAt(const model::CharacterPose& pose,
                                             const model::SegmentLayout& layout, int position);

} // namespace posewire::exporting
