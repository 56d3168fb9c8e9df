// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/joints.h"
#include "render/mesh/mesh.h"

#include <span>
#include <string>

namespace posewire::render {

/// Stretches a mesh from one null pose to a performer's: v' = Σ wᵢ (o'ᵢ + Sᵢ (v − oᵢ)), with the weights of
/// twist and half joints counted for their segments. Null poses have identity orientations, so that a
/// diagonal Sᵢ is exact: along the bone it is the ratio of the lengths, across it the girth that follows from
/// the stature. Where a length is zero, not finite or absurd, the reference's is used.
struct NullPoseFitJob {
    const SkinnedMesh* mesh = nullptr;
    /// Segment origins that the mesh was made for, metres.
    std::span<const glm::vec3> reference;
    /// The performer's segment origins (type 13), metres, Z-up.
    std::span<const glm::vec3> performer;
    /// Fitted vertices, in the performer's null-pose frame.
    std::span<glm::vec3> positions;
    /// The mesh's normals turned by the stretch (by the inverse of its diagonal, the change of weights left
    /// out): they keep the template's smoothness at any detail.
    std::span<glm::vec3> normals;
    /// The performer's origins as used, with unusable ones replaced: the palette must be made with these.
    std::span<glm::vec3> origins;
    /// The origins of both hands' segments, kFingerJointCount or none; fingers that are not finite, or none,
    /// fit the hands.
    std::span<const glm::vec3> performerFingers{};
    /// None, or kFingerJointCount as used.
    std::span<glm::vec3> fingerOrigins{};

    tl::expected<void, std::string> validate() const;
    void run() const;
};

/// Where the fit puts the fingers of a body with these segment origins where none are sent.
FingerOrigins fittedFingers(std::span<const glm::vec3> origins);

/// The mesh fitted to the performer, by NullPoseFitJob from kReferenceNullPose. `usedOrigins` receives its
/// `origins`.
SkinnedMesh fitToNullPose(const SkinnedMesh& mesh, const NullPose& performer, NullPose& usedOrigins);
/// With fingers, which may be anything but finite.
SkinnedMesh fitToNullPose(const SkinnedMesh& mesh, const NullPose& performer,
                          const FingerOrigins& performerFingers, NullPose& usedOrigins,
                          FingerOrigins& usedFingers);

} // namespace posewire::render
