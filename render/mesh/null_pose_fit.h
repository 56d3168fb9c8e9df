// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/joints.h"
#include "render/mesh/mesh.h"

#include <array>
#include <span>

namespace posewire::render {

/// Where a point of the mannequin lies on another body: v' = scale ∘ v + shift.
struct Stretch {
    glm::vec3 scale{1.0F};
    glm::vec3 shift{0.0F};

    glm::vec3 operator()(const glm::vec3& v) const { return scale * v + shift; }
    bool operator==(const Stretch&) const = default;
};

/// The mannequin stretched from its null pose to a performer's: v' = Σ wᵢ (o'ᵢ + Sᵢ (v − oᵢ)), with the
/// weights of twist and half joints counted for their segments. Null poses have identity orientations, so
/// that a diagonal Sᵢ is exact: along the bone it is the ratio of the lengths, across it the girth that
/// follows from the stature. Where a length is zero, not finite or absurd, the reference's is used.
struct BodyFit {
    /// The performer's segment origins as used, with unusable ones replaced, in metres, Z-up: palettes of
    /// this body must be made with these.
    NullPose origins{};
    FingerOrigins fingerOrigins{};
    std::array<Stretch, kJointCount> stretches{};
};

/// What is no number: the fingers of a body of which none are sent.
const FingerOrigins& unknownFingers();

/// By a performer's segment origins (type 13), metres, Z-up; any of them may be of any value. Fingers that
/// are not finite fit the hands.
BodyFit fitBody(const NullPose& performer, const FingerOrigins& fingers = unknownFingers());

/// The mannequin's mesh on that body, as the vertex shader places it. Normals are turned by the inverse of
/// the stretch's diagonal, the change of weights left out: they keep the template's smoothness at any detail.
SkinnedMesh fitted(const SkinnedMesh& mannequin, const BodyFit& fit);

/// Where the fit puts the fingers of a body with these segment origins where none are sent.
FingerOrigins fittedFingers(std::span<const glm::vec3> origins);

} // namespace posewire::render
