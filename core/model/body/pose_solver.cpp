// SPDX-License-Identifier: MIT
#include "core/model/body/pose_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace posewire::model {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Shares of the turn from pelvis to T8 that MVN gives to L5, L3 and T12: its joints turn as
/// 1 : 0.444 : 0.444 : 0.333, measured in recordings.
constexpr std::array<double, 3> kSpineShares{1.0 / 2.221, 1.444 / 2.221, 1.888 / 2.221};

/// How much of the turn from T8 to the head about its own axis the neck has, in a recording.
constexpr double kNeckShare = 1.0 / 3.0;

/// A limb of two bones that bends about one axis of both.
struct Hinge {
    int upper, lower, end;
    Vector3d axis; ///< in both segments: upper bone × lower bone where it bends
};

const std::array<Hinge, 6>& hinges() {
    using namespace segment;
    static const std::array<Hinge, 6> all{{
        {kRightUpperArm, kRightForeArm, kRightHand, Vector3d::UnitZ()},
        {kLeftUpperArm, kLeftForeArm, kLeftHand, -Vector3d::UnitZ()},
        {kRightUpperLeg, kRightLowerLeg, kRightFoot, Vector3d::UnitY()},
        {kLeftUpperLeg, kLeftLowerLeg, kLeftFoot, Vector3d::UnitY()},
        {kRightLowerLeg, kRightFoot, kRightToe, -Vector3d::UnitY()},
        {kLeftLowerLeg, kLeftFoot, kLeftToe, -Vector3d::UnitY()},
    }};
    return all;
}

bool isSpine(std::size_t segment) {
    return segment >= segment::kL5 && segment <= segment::kT12;
}

class Solver {
public:
    Solver(const PoseEvidence& evidence, const BodyOrigins& body) : m_evidence(evidence), m_body(body) {}

    SolvedBody run() {
        takeSent();
        fitAllMarkers();
        fitMarkersAndJoints();
        placePelvis();
        fitAsBefore(segment::kT8);
        if (!has(segment::kT8, &SegmentSource::orientation)) {
            turn(segment::kT8, m_solved.segments[segment::kPelvis].orientation);
        }
        for (std::size_t i = 1; i < kCount; ++i) {
            solve(i);
        }
        if (m_solved.isPlaceAssumed) {
            standOnFloor();
        }
        return m_solved;
    }

private:
    static constexpr std::size_t kCount = kBodySegmentCount;

    [[nodiscard]] bool has(std::size_t i, Provenance SegmentSource::*part) const {
        return m_solved.sources[i].*part != Provenance::None;
    }
    [[nodiscard]] Vector3d bone(std::size_t i) const { return m_body.places[i] - m_body.places[parentOf(i)]; }

    void takeSent() {
        for (std::size_t i = 0; i < kCount; ++i) {
            if (m_evidence.positions[i]) {
                m_solved.segments[i].position = *m_evidence.positions[i];
                m_solved.sources[i].position = Provenance::Sent;
            }
            if (m_evidence.orientations[i]) {
                m_solved.segments[i].orientation = *m_evidence.orientations[i];
                m_solved.sources[i].orientation = Provenance::Sent;
            }
        }
    }

    void fitAllMarkers() {
        for (std::size_t i = 0; i < kCount; ++i) {
            const bool isTurned = has(i, &SegmentSource::orientation);
            if (isTurned && !has(i, &SegmentSource::position)) {
                placeByMarkers(i);
            } else if (!isTurned) {
                fit(i, m_evidence.markers[i]);
            }
        }
    }

    /// Segments that have too few markers, with the joints of those beside them that are fitted.
    void fitMarkersAndJoints() {
        for (bool isMore = true; isMore;) {
            isMore = false;
            for (std::size_t i = 0; i < kCount; ++i) {
                const SegmentSource before = m_solved.sources[i];
                if (!m_evidence.markers[i].empty() && before.orientation == Provenance::None &&
                    before.position == Provenance::None) {
                    fit(i, jointsAround(i));
                    isMore = isMore || has(i, &SegmentSource::orientation);
                }
            }
        }
    }

    void fit(std::size_t i, const std::vector<MarkerPair>& pairs) {
        if (const auto fitted = fitMarkers(pairs, m_evidence.markerTolerance)) {
            SegmentSource& source = m_solved.sources[i];
            m_solved.segments[i].orientation = fitted->rotation;
            source.orientation = Provenance::Solved;
            if (source.position == Provenance::None) {
                m_solved.segments[i].position = fitted->position;
                source.position = Provenance::Solved;
            }
        }
    }

    /// The origin where its markers, as it is turned, put it: of each coordinate the median.
    void placeByMarkers(std::size_t i) {
        const std::vector<MarkerPair>& markers = m_evidence.markers[i];
        if (markers.empty()) {
            return;
        }
        SegmentPose& pose = m_solved.segments[i];
        std::vector<double> values(markers.size());
        for (int axis = 0; axis < 3; ++axis) {
            for (std::size_t k = 0; k < markers.size(); ++k) {
                values[k] = (markers[k].world - pose.orientation * markers[k].local)[axis];
            }
            const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
            std::nth_element(values.begin(), middle, values.end());
            pose.position[axis] = *middle;
        }
        m_solved.sources[i].position = Provenance::Solved;
    }

    void placePelvis() {
        constexpr std::size_t kPelvis = segment::kPelvis;
        SegmentPose& pelvis = m_solved.segments[kPelvis];
        SegmentSource& source = m_solved.sources[kPelvis];
        if (source.orientation == Provenance::None) {
            if (source.position != Provenance::None) {
                turn(kPelvis, Quaterniond::Identity());
            } else if (const auto fit = fitMarkers(joints(kPelvis), std::numeric_limits<double>::max())) {
                pelvis = {fit->position, fit->rotation};
                source = {Provenance::Solved, Provenance::Solved};
            } else {
                source.orientation = Provenance::Assumed;
            }
        }
        if (source.position == Provenance::None) {
            placeByChildren(kPelvis);
        }
        if (source.position == Provenance::None) {
            pelvis.position = m_body.places[kPelvis];
            source.position = Provenance::Assumed;
            m_solved.isPlaceAssumed = true;
        }
    }

    /// The joints with children whose origins are known, and the markers.
    [[nodiscard]] std::vector<MarkerPair> joints(std::size_t i) const {
        std::vector<MarkerPair> pairs = m_evidence.markers[i];
        for (std::size_t child = i + 1; child < kCount; ++child) {
            if (parentOf(child) == i && has(child, &SegmentSource::position)) {
                pairs.push_back({bone(child), m_solved.segments[child].position});
            }
        }
        return pairs;
    }

    /// The same, and its origin where the parent, all of which is known, has it.
    [[nodiscard]] std::vector<MarkerPair> jointsAround(std::size_t i) const {
        std::vector<MarkerPair> pairs = joints(i);
        if (i == segment::kPelvis) {
            return pairs;
        }
        const std::size_t parent = parentOf(i);
        if (has(parent, &SegmentSource::position) && has(parent, &SegmentSource::orientation)) {
            const SegmentPose& from = m_solved.segments[parent];
            pairs.push_back({Vector3d::Zero(), from.position + from.orientation * bone(i)});
        }
        return pairs;
    }

    void placeByChildren(std::size_t i) {
        const std::vector<MarkerPair> pairs = joints(i);
        Vector3d sum = Vector3d::Zero();
        for (const MarkerPair& pair : pairs) {
            sum += pair.world - m_solved.segments[i].orientation * pair.local;
        }
        if (!pairs.empty()) {
            m_solved.segments[i].position = sum / static_cast<double>(pairs.size());
            m_solved.sources[i].position = Provenance::Solved;
        }
    }

    void solve(std::size_t i) {
        SegmentSource& source = m_solved.sources[i];
        const std::size_t parent = parentOf(i);
        const SegmentPose& from = m_solved.segments[parent];
        if (!isSpine(i)) {
            fitAsBefore(i);
        }
        if (source.position == Provenance::None) {
            m_solved.segments[i].position = from.position + from.orientation * bone(i);
            const SegmentSource& basis = m_solved.sources[parent];
            // That a whole body stands at an assumed place is said of the pelvis alone.
            const bool isAssumed = basis.orientation == Provenance::Assumed ||
                                   (basis.position == Provenance::Assumed && parent != segment::kPelvis);
            source.position = isAssumed ? Provenance::Assumed : Provenance::Solved;
        }
        if (source.orientation == Provenance::None) {
            turn(i, priorOf(i));
            if (isSpine(i) && isSpineKnown() && !m_evidence.positions[i]) {
                placeByMarkers(i);
            }
        }
    }

    /// As it would be turned if nothing were known of the segment itself.
    [[nodiscard]] Quaterniond priorOf(std::size_t i) const {
        if (isSpine(i)) {
            const Quaterniond& pelvis = m_solved.segments[segment::kPelvis].orientation;
            return pelvis.slerp(kSpineShares[i - segment::kL5], m_solved.segments[segment::kT8].orientation);
        }
        const Quaterniond& parent = m_solved.segments[parentOf(i)].orientation;
        const bool isNeck = i == segment::kNeck && has(segment::kHead, &SegmentSource::orientation);
        return isNeck ? parent.slerp(kNeckShare, m_solved.segments[segment::kHead].orientation) : parent;
    }

    /// Turns a segment to what is known of its joints, its markers and the plane of its limb, and for the
    /// rest as it was before, or as `prior`.
    void turn(std::size_t i, const Quaterniond& prior) {
        SegmentSource& source = m_solved.sources[i];
        const bool isSolvedSpine = isSpine(i) && isSpineKnown();
        std::vector<VectorPair> vectors;
        // Between pelvis and T8 the rule is better than markers that are this near, and than origins that
        // rest on it.
        if (source.position != Provenance::None && (!isSolvedSpine || m_evidence.positions[i])) {
            for (const MarkerPair& joint : joints(i)) {
                vectors.push_back({joint.local, joint.world - m_solved.segments[i].position});
            }
        }
        // That knees and elbows are hinges is an assumption: what they tell of the twist is no knowledge.
        const std::vector<VectorPair> known = vectors;
        const RotationRank rank = fitRotation(known, prior).rank;
        double bent = 0;
        for (std::size_t k = 0; k < hinges().size(); ++k) {
            const Hinge& hinge = hinges()[k];
            const LimbBend& bend = m_body.bends[k];
            if (static_cast<std::size_t>(hinge.upper) == i) {
                bent = std::max(bent, addHinge(hinge, bend.upper, vectors));
            } else if (static_cast<std::size_t>(hinge.lower) == i) {
                bent = std::max(bent, addHinge(hinge, bend.lower, vectors));
            }
        }
        m_solved.segments[i].orientation = fitRotation(vectors, prior).rotation;
        if (m_evidence.before && rank != RotationRank::Whole && !isSpine(i)) {
            hold(i, fitRotation(known, asBefore(i)).rotation, bent);
        }
        source.isTwistAssumed = rank == RotationRank::Direction && !isSolvedSpine;
        source.orientation =
            rank == RotationRank::Nothing && !isSolvedSpine ? Provenance::Assumed : Provenance::Solved;
    }

    /// Fits a segment to its few markers and the joints beside it, and for the rest as it was before: its
    /// origin moves with them.
    void fitAsBefore(std::size_t i) {
        SegmentSource& source = m_solved.sources[i];
        if (!m_evidence.before || m_evidence.markers[i].empty() || source.orientation != Provenance::None ||
            source.position != Provenance::None) {
            return;
        }
        const std::vector<MarkerPair> pairs = jointsAround(i);
        if (pairs.size() < 2) {
            return;
        }
        MarkerPair centre;
        for (const MarkerPair& pair : pairs) {
            centre.local += pair.local / static_cast<double>(pairs.size());
            centre.world += pair.world / static_cast<double>(pairs.size());
        }
        std::vector<VectorPair> vectors;
        for (const MarkerPair& pair : pairs) {
            vectors.push_back({pair.local - centre.local, pair.world - centre.world});
        }
        source.heldSeconds =
            m_evidence.before->heldSeconds[i] + static_cast<float>(m_evidence.before->seconds);
        // In a twentieth of a second a segment turns by less than a marker that is so near to it is off.
        constexpr double kPriorWeight = 0.16;
        constexpr double kPriorSeconds = 0.05;
        const double priorWeight = kPriorWeight * std::exp(-source.heldSeconds / kPriorSeconds);
        const FittedRotation fitted = fitRotation(vectors, asBefore(i), priorWeight);
        m_solved.segments[i] = {centre.world - fitted.rotation * centre.local, fitted.rotation};
        source.position = Provenance::Solved;
        source.orientation = Provenance::Solved;
        source.isTwistAssumed = fitted.rank != RotationRank::Whole;
    }

    /// Returns it turned in its parent as it was before; the pelvis in the world, and T8 in the pelvis, since
    /// the spine between them follows from both.
    [[nodiscard]] Quaterniond asBefore(std::size_t i) const {
        const auto& before = m_evidence.before->orientations;
        if (i == segment::kPelvis) {
            return before[i];
        }
        const std::size_t parent = i == segment::kT8 ? std::size_t{segment::kPelvis} : parentOf(i);
        return m_solved.segments[parent].orientation * before[parent].conjugate() * before[i];
    }

    /// Leads from a rotation that is held toward the one that was solved, never at once: as fast as the bend
    /// of the limb is sure, and slowly once it was held for kHold.
    void hold(std::size_t i, const Quaterniond& held, double bent) {
        constexpr double kFollowing = 1.6; // radians a second: 1.5° at 60 Hz
        constexpr double kReturning = 1.6;
        const double seconds = m_evidence.before->seconds;
        Quaterniond& solved = m_solved.segments[i].orientation;
        float& age = m_solved.sources[i].heldSeconds;
        age = bent > 0.5 ? 0.0F : m_evidence.before->heldSeconds[i] + static_cast<float>(seconds);
        const double most = seconds * std::max(kFollowing * bent, age > kHold ? kReturning : 0.0);
        const double apart = held.angularDistance(solved);
        if (apart > most) {
            solved = held.slerp(most / apart, solved);
        }
    }

    [[nodiscard]] bool isSpineKnown() const {
        return m_solved.sources[segment::kPelvis].orientation > Provenance::Assumed &&
               m_solved.sources[segment::kT8].orientation > Provenance::Assumed;
    }

    /// The axis that a limb bends about, the surer the more it is bent: from 0 to 1, which it returns.
    double addHinge(const Hinge& hinge, const Vector3d& learned, std::vector<VectorPair>& vectors) const {
        constexpr double kSure = 0.17; // sine of 10°
        constexpr double kWeight = 0.3;
        const auto upper = static_cast<std::size_t>(hinge.upper);
        const auto lower = static_cast<std::size_t>(hinge.lower);
        const auto end = static_cast<std::size_t>(hinge.end);
        if (!m_evidence.positions[upper] || !m_evidence.positions[lower] || !m_evidence.positions[end]) {
            return 0;
        }
        const Vector3d first = (*m_evidence.positions[lower] - *m_evidence.positions[upper]).normalized();
        const Vector3d second = (*m_evidence.positions[end] - *m_evidence.positions[lower]).normalized();
        const Vector3d normal = first.cross(second);
        const double sine = normal.norm();
        if (sine <= 1e-6) {
            return 0;
        }
        const double bent = std::pow(sine, 4);
        const double sureness = bent / (bent + std::pow(kSure, 4));
        constexpr double kLength = 0.1; // that of a vector with this weight
        vectors.push_back({kLength * (learned.isZero() ? hinge.axis : learned), kLength * normal / sine,
                           kWeight * sureness});
        return sureness;
    }

    /// Moves the body so that the lowest point of its soles is on the floor.
    void standOnFloor() {
        double lowest = std::numeric_limits<double>::max();
        for (const auto& [segment, point] : kSolePoints) {
            const SegmentPose& pose = m_solved.segments[static_cast<std::size_t>(segment)];
            const Vector3d local = m_body.pointOf(segment, point).value_or(Vector3d::Zero());
            lowest = std::min(lowest, (pose.position + pose.orientation * local).z());
        }
        for (SegmentPose& segment : m_solved.segments) {
            segment.position.z() -= lowest;
        }
    }

    const PoseEvidence& m_evidence;
    const BodyOrigins& m_body;
    SolvedBody m_solved;
};

/// Positive where `c` is to the left of the way from `a` to `b`.
double turn(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// One side of the hull.
template <class Points>
void addChain(const Points& points, std::vector<Vector3d>& hull) {
    const std::size_t first = hull.size();
    for (const Vector3d& point : points) {
        while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0) {
            hull.pop_back();
        }
        hull.push_back(point);
    }
    hull.pop_back(); // it begins the other side
}

} // namespace

SolvedBody solveBody(const PoseEvidence& evidence, const BodyOrigins& body) {
    return Solver(evidence, body).run();
}

void BendMeasure::add(const wire::Datagram& datagram) {
    const bool isEnough = std::ranges::all_of(m_counts, [](std::uint32_t count) { return count >= kEnough; });
    if (isEnough || !datagram.header.isLast() || m_seen++ % kEvery != 0) {
        return;
    }
    const PosePart part{&datagram};
    CharacterPose pose;
    if (!poseFromParts({&part, 1}, {referenceOrigins()}, nullptr, 0, pose) || pose.isObjects) {
        return;
    }
    constexpr double kBent = 0.34; // sine of 20°
    for (std::size_t i = 0; i < m_counts.size(); ++i) {
        const auto& [upper, lower, end, axis] = hinges()[i];
        const SegmentPose& from = pose.segments[static_cast<std::size_t>(upper)];
        const SegmentPose& to = pose.segments[static_cast<std::size_t>(lower)];
        const bool isSent = pose.sources[static_cast<std::size_t>(upper)].orientation == Provenance::Sent &&
                            pose.sources[static_cast<std::size_t>(lower)].orientation == Provenance::Sent;
        const Vector3d normal =
            (to.position - from.position)
                .normalized()
                .cross((pose.segments[static_cast<std::size_t>(end)].position - to.position).normalized());
        if (isSent && normal.allFinite() && normal.norm() > kBent) {
            m_sums[i].upper += from.orientation.conjugate() * normal;
            m_sums[i].lower += to.orientation.conjugate() * normal;
            ++m_counts[i];
        }
    }
}

std::array<LimbBend, 6> BendMeasure::bends() const {
    constexpr std::uint32_t kFewest = 8;
    std::array<LimbBend, 6> bends{};
    for (std::size_t i = 0; i < bends.size(); ++i) {
        if (m_counts[i] >= kFewest) {
            bends[i] = {m_sums[i].upper.normalized(), m_sums[i].lower.normalized()};
        }
    }
    return bends;
}

std::vector<Vector3d> soleContacts(const CharacterPose& pose, const BodyOrigins& body) {
    std::vector<Vector3d> contacts;
    for (const SolePoint& point : kSolePoints) {
        const auto place = static_cast<std::size_t>(point.segment);
        const auto local = body.pointOf(point.segment, point.localId);
        if (pose.isObjects || !pose.isPresent(place) || !local) {
            continue;
        }
        const Vector3d at = pose.segments[place].position + pose.segments[place].orientation * *local;
        if (at.z() < kContactHeight) {
            contacts.push_back(at);
        }
    }
    return contacts;
}

std::vector<Vector3d> supportPolygon(std::vector<Vector3d> points) {
    if (points.size() < 3) {
        return points;
    }
    std::ranges::sort(points, {}, [](const Vector3d& point) { return std::tuple(point.x(), point.y()); });
    std::vector<Vector3d> hull;
    addChain(points, hull);
    std::ranges::reverse(points);
    addChain(points, hull);
    return hull;
}

} // namespace posewire::model
