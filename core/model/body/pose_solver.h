// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/character_pose.h"
#include "core/model/body/provenance.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/rigid_fit.h"
#include "core/model/body/segments.h"
#include "core/model/body/spaces.h"

#include <array>
#include <optional>
#include <vector>

namespace posewire::model {

/// World, metres.
struct PoseEvidence {
    std::array<std::optional<Eigen::Vector3d>, kBodySegmentCount> positions;
    std::array<std::optional<Eigen::Quaterniond>, kBodySegmentCount> orientations; ///< worldFromSegment
    std::array<std::vector<MarkerPair>, kBodySegmentCount> markers;
    /// How far a marker may be from where its segment puts it; more where the performer's own points are not
    /// known.
    double markerTolerance = 0.015;

    /// The body as it was solved a little before, from messages of the same types.
    struct Before {
        std::array<Eigen::Quaterniond, kBodySegmentCount> orientations;
        std::array<float, kBodySegmentCount> heldSeconds;
        double seconds = 0; ///< between it and now
    };
    std::optional<Before> before{};
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
/// the plane in which a knee or an elbow bends; the spine turns as MVN interpolates it. A segment
/// whose turn follows from none of these keeps it in its parent for kHold, and is then led steadily to the
/// one that it has without a `before`: with its parent by the shortest way. It is marked, as is everything
/// that rests on nothing that was sent. A `before` has no influence after kForgotten.
[[nodiscard]] SolvedBody solveBody(const PoseEvidence& evidence, const BodyOrigins& body);
inline constexpr double kHold = 1.0;      ///< seconds
inline constexpr double kForgotten = 2.5; ///< seconds

/// Learns how the limbs of a performer bend from poses whose orientations were sent: the axes of elbows and
/// knees that bodies without orientations are solved with.
class BendMeasure {
public:
    /// Of a datagram that holds a whole sample. One of 16 is looked at, until all limbs have bent often.
    void add(const wire::Datagram& datagram);
    [[nodiscard]] std::array<LimbBend, 6> bends() const;

private:
    static constexpr std::uint32_t kEvery = 16;
    static constexpr std::uint32_t kEnough = 256;
    std::array<LimbBend, 6> m_sums{};
    std::array<std::uint32_t, 6> m_counts{};
    std::uint32_t m_seen = 0;
};

/// Nearer to the floor than this, a point of a sole stands on it: soles of recordings are up to 4 mm above
/// it, and flesh gives way. Metres.
inline constexpr double kContactHeight = 0.02;

/// Points of both soles: heel, balls, tip of the toe.
struct SolePoint {
    int segment;
    int localId;
};
inline constexpr std::array<SolePoint, 8> kSolePoints{{
    {segment::kRightFoot, 3},
    {segment::kRightFoot, 4},
    {segment::kRightFoot, 5},
    {segment::kRightToe, 2},
    {segment::kLeftFoot, 3},
    {segment::kLeftFoot, 4},
    {segment::kLeftFoot, 5},
    {segment::kLeftToe, 2},
}};

/// Those that stand on the floor z = 0, in the world.
[[nodiscard]] std::vector<Eigen::Vector3d> soleContacts(const CharacterPose& pose, const BodyOrigins& body);

/// Convex hull of points as seen from above, counter-clockwise (monotone chain, Andrew 1979): the base of
/// support. Fewer than three where the points lie on a line.
[[nodiscard]] std::vector<Eigen::Vector3d> supportPolygon(std::vector<Eigen::Vector3d> points);

} // namespace posewire::model
