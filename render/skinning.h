// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/joints.h"
#include "render/mesh/mesh.h"

#include <span>
#include <string>

#include <glm/gtc/quaternion.hpp>
#include <tl/expected.hpp>

namespace posewire::render {

/// A rigid motion as the shaders read it: two vec4 in the order x y z w.
struct DualQuaternion {
    glm::vec4 real{0.0F, 0.0F, 0.0F, 1.0F};
    glm::vec4 dual{0.0F};

    bool operator==(const DualQuaternion&) const = default;
};
static_assert(sizeof(DualQuaternion) == 2 * sizeof(glm::vec4));

/// The motion v → R (v − origin) + position (Kavan et al., Geometric Skinning with Approximate Dual
/// Quaternion Blending).
DualQuaternion rigidMotion(const glm::quat& rotation, const glm::vec3& origin, const glm::vec3& position);

/// Where a rigid motion takes a point.
glm::vec3 transformPoint(const DualQuaternion& motion, const glm::vec3& point);

/// The segments of one hand, world frame, metres; empty where nothing is known about the fingers.
struct FingerPose {
    /// None, or kHandSegmentCount of each.
    std::span<const glm::vec3> positions{};
    std::span<const glm::quat> orientations{};

    bool isPresent() const { return !positions.empty(); }
};

/// Makes the palette of one character from its pose: joint i maps v to Rᵢ (v − oᵢ) + pᵢ.
/// Twist joints follow their segment without its twist against the parent, half joints by half of that,
/// shifted so that the flesh keeps its form. Signs are consistent along the hierarchy. An orientation without
/// length or not finite counts as its parent's, a position not finite as at its null-pose offset from the
/// parent. Fingers that are not known rest relaxed.
struct PaletteJob {
    /// kSegmentCount of each, world frame, metres.
    std::span<const glm::vec3> positions;
    std::span<const glm::quat> orientations;
    /// Null-pose origins of the mesh that is drawn, metres.
    std::span<const glm::vec3> origins;
    /// kJointCount.
    std::span<DualQuaternion> palette;
    FingerPose leftHand{};
    FingerPose rightHand{};
    /// Null-pose origins of the fingers of the mesh that is drawn, kFingerJointCount; none is as
    /// fittedFingers has them.
    std::span<const glm::vec3> fingerOrigins{};

    tl::expected<void, std::string> validate() const;
    void run() const;
};

/// Dual-quaternion skinning on the CPU, the reference for the vertex shader: signs are flipped against the
/// joint of the largest weight.
struct SkinJob {
    const SkinnedMesh* mesh = nullptr;
    std::span<const DualQuaternion> palette;
    std::span<glm::vec3> positions;
    std::span<glm::vec3> normals;

    tl::expected<void, std::string> validate() const;
    void run() const;
};

} // namespace posewire::render
