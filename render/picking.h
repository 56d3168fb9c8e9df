// SPDX-License-Identifier: MIT
#pragma once

#include "render/camera.h"
#include "render/mesh/null_pose_fit.h"
#include "render/skinning.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace posewire::render {

struct Capsule {
    glm::vec3 from{0.0F};
    glm::vec3 to{0.0F};
    /// Negative: there is nothing.
    float radius = -1.0F;
    /// Whose motion it follows.
    std::size_t joint = 0;
};

/// One capsule per segment around the vertices that follow it most, in the mesh's null pose.
using SegmentCapsules = std::array<Capsule, kSegmentCount>;
SegmentCapsules segmentCapsules(const SkinnedMesh& mesh);
/// The same for other joints than the mannequin's: the segment that each follows, and the joint of each
/// segment, or -1.
SegmentCapsules segmentCapsules(const SkinnedMesh& mesh, std::span<const Segment> jointSegments,
                                std::span<const int> segmentJoints);
/// Those of the mannequin on a body that it is fitted to; `stretches` by joint.
SegmentCapsules stretched(const SegmentCapsules& capsules, std::span<const Stretch> stretches);
/// The capsule where its joint's motion puts it.
Capsule posed(const Capsule& capsule, const DualQuaternion& motion);

struct PickTarget {
    std::uint32_t id = 0;
    const SegmentCapsules* capsules = nullptr;
    /// As for drawing.
    std::span<const DualQuaternion> palette;
};

struct Pick {
    std::uint32_t id = 0;
    int segment = -1;
    /// Along the ray, metres.
    float distance = 0.0F;
};

/// The nearest segment that the ray meets. Needs no OpenGL.
std::optional<Pick> pickSegment(const Ray& ray, std::span<const PickTarget> targets);
/// Distance along the ray at which it enters the capsule; 0 where it starts inside.
std::optional<float> intersect(const Ray& ray, const Capsule& capsule);

} // namespace posewire::render
