// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/provenance.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/rigid_fit.h"
#include "core/model/body/segments.h"
#include "core/model/body/spaces.h"

#include <array>
#include <optional>
#include <vector>

namespace posewire::model {

/// What is known of the 23 segments of a body at one sample. World, metres.
struct PoseEvidence {
    std::array<std::optional<Eigen::Vector3d>, kBodySegmentCount> positions;
    std::array<std::optional<Eigen::Quaterniond>, kBodySegmentCount> orientations; ///< worldFromSegment
    std::array<std::vector<MarkerPair>, kBodySegmentCount> markers;
    /// How far a marker may be from where its segment puts it; more where the performer's own points are not
    /// known.
    double markerTolerance = 0.015;

    /// Forgets what it holds, not its memory.
    void clear();
};

/// A whole body.
struct SolvedBody {
    std::array<SegmentPose, kBodySegmentCount> segments;
    std::array<SegmentSource, kBodySegmentCount> sources;
    /// Nothing says where in the world it is: it stands on the floor, its pelvis above the origin.
    bool isPlaceAssumed = false;
};

/// Puts a whole body together from what is known of it. What was sent stays as it is, joints may be open.
/// Segments with three markers or more are fitted to them, those with fewer to theirs and to the joints of
/// fitted ones beside them where these make three. What is left is solved from the pelvis outward:
/// an origin by the bone from its parent, an orientation from the joints and markers of its segment, and from
/// the plane in which a knee or an elbow bends; the spine turns as MVN interpolates it. How a limb is turned
/// about itself where nothing tells goes with its parent by the shortest way, so it moves steadily; it is
/// marked, as is everything that rests on nothing that was sent.
[[nodiscard]] SolvedBody solveBody(const PoseEvidence& evidence, const BodyOrigins& body);

} // namespace posewire::model
