// SPDX-License-Identifier: MIT
#include "core/model/body/character_pose.h"

#include "core/model/body/points.h"
#include "core/model/body/pose_messages.h"
#include "core/model/body/pose_solver.h"
#include "core/wire/tags.h"

#include <algorithm>

namespace posewire::model {
namespace {

/// A quaternion of no length tells nothing.
bool isRotation(const std::array<float, 4>& wire) {
    constexpr double kShortest = 1e-6;
    const double squares = toQuaternion(wire).squaredNorm();
    return std::isfinite(squares) && squares > kShortest * kShortest;
}

/// Type 01 has angles, which always tell an orientation.
bool isTurned(const wire::SegmentEuler&) {
    return true;
}
bool isTurned(const wire::SegmentQuaternion& item) {
    return isRotation(item.orientation);
}

void prepare(CharacterPose& pose, const wire::Header& header, const SegmentLayout& layout) {
    pose.layout = layout;
    pose.segments.assign(static_cast<std::size_t>(layout.count()), {});
    pose.sources.assign(static_cast<std::size_t>(layout.count()), {});
    pose.type = header.type();
    pose.types.assign(1, pose.type);
    pose.sample = header.sampleCounter;
    pose.timeCode = header.timeCode;
    pose.isObjects = false;
    pose.isPlaceAssumed = false;
    pose.isLifted = false;
    pose.moved.setZero();
}

/// Where the items of a whole message are in the pose.
struct Placement {
    SegmentLayout layout;
    std::vector<int> positions; ///< of each item
    bool isObjects = false;
};

template <class Items>
Placement placementOf(const wire::Header& header, const Items& items) {
    const std::vector<std::uint32_t> ids = idsOf(items);
    const auto firstId = ids.empty() ? std::nullopt : std::optional(ids.front());
    const ItemPlaces places = itemPlaces(header, items.size(), firstId);
    Placement placement{places.layout, {}, isOfObjects(header, ids)};
    // A body lacks segments: what follows it keeps its place behind the others.
    const int missing =
        placement.isObjects ? 0 : kBodySegmentCount - std::min(places.layout.body, kBodySegmentCount);
    placement.layout.body += missing;
    int next = placement.layout.body;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (static_cast<int>(i) < places.layout.body) {
            placement.positions.push_back(places.positionOf(i, ids[i]));
        } else if (wire::isTag(header, items, i)) {
            placement.positions.push_back(-1);
            --placement.layout.props;
        } else {
            placement.positions.push_back(next++);
        }
    }
    return placement;
}

/// Items by their IDs, each placed by `toPose(item)`; the first of those with one ID.
template <class Items, class ToPose>
bool read(const Items& items, const wire::Header& header, CharacterPose& pose, ToPose toPose) {
    const Placement placement = placementOf(header, items);
    prepare(pose, header, placement.layout);
    pose.isObjects = placement.isObjects;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const SegmentPose segment = toPose(items[i]);
        const auto position = static_cast<std::size_t>(placement.positions[i]);
        if (position >= pose.segments.size() || pose.isPresent(position)) {
            continue;
        }
        SegmentSource& source = pose.sources[position];
        source.isBroken = true;
        if (isPlace(segment.position) && segment.orientation.coeffs().allFinite()) {
            pose.segments[position] = segment;
            source.position = Provenance::Sent;
            source.orientation = isTurned(items[i]) ? Provenance::Sent : Provenance::None;
            source.isBroken = !isTurned(items[i]);
        }
    }
    return true;
}

/// Chains the local rotations from the pelvis outward, parents before children, by the positions that were
/// sent; by the bones of the null pose if those are not filled in, or of another meaning.
bool readUnity(const wire::PoseUnity& message, const wire::Header& header,
               std::span<const Eigen::Vector3d> origins, LengthUnit unit, CharacterPose& pose) {
    constexpr double kAgreement = 0.5; // of a bone: more than people differ by, less than from zero
    prepare(pose, header, segmentLayout(header, kBodySegments));
    if (message.segments.size() < kBodySegments || origins.size() < kBodySegments) {
        return false;
    }
    const auto& places = unityPlaces();
    for (std::size_t i = 0; i < kBodySegments; ++i) {
        const auto& item = message.segments[static_cast<std::size_t>(places[i])];
        const SegmentPose local = poseFromUnity(item, unit);
        const int parent = bodySegments()[i].parent;
        const auto from = static_cast<std::size_t>(std::max(parent, 0));
        const Eigen::Vector3d bone = origins[i] - origins[from];
        const bool isSent = parent < 0 || (local.position - bone).norm() < kAgreement * bone.norm();
        const bool isFinite = local.orientation.coeffs().allFinite() &&
                              (parent >= 0 ? pose.isPresent(from) : isPlace(local.position));
        if (isFinite) {
            const SegmentPose shown{isSent ? local.position : bone, local.orientation};
            pose.segments[i] = parent < 0 ? local : composed(pose.segments[from], shown);
            const Provenance basis = parent < 0 ? Provenance::Sent : pose.sources[from].position;
            pose.sources[i] = {isSent ? basis : Provenance::Solved,
                               isRotation(item.orientation) ? Provenance::Sent : Provenance::None};
        }
    }
    return true;
}

struct SentItems {
    SegmentLayout layout;
    bool isObjects = false;
    std::array<std::optional<Eigen::Vector3d>, kMaxSegmentCount> positions;
    std::array<std::optional<Eigen::Quaterniond>, kMaxSegmentCount> orientations;

    template <class Items, class Take>
    void add(const Items& items, const wire::Header& header, Take take) {
        const Placement placement = placementOf(header, items);
        layout = placement.layout;
        isObjects = placement.isObjects;
        for (std::size_t i = 0; i < items.size(); ++i) {
            const auto position = static_cast<std::size_t>(placement.positions[i]);
            if (position < positions.size()) {
                take(items[i], position);
            }
        }
    }

    void add(const wire::LinearKinematics& message, const wire::Header& header, LengthUnit unit) {
        add(message.segments, header, [&](const wire::LinearSegment& item, std::size_t position) {
            const Eigen::Vector3d place = toVector(item.position) * metresPer(unit);
            if (!positions[position] && isPlace(place)) {
                positions[position] = place;
            }
        });
    }

    void add(const wire::AngularKinematics& message, const wire::Header& header) {
        add(message.segments, header, [&](const wire::AngularSegment& item, std::size_t position) {
            if (!orientations[position] && isRotation(item.orientation)) {
                orientations[position] = normalizedOrIdentity(toQuaternion(item.orientation));
            }
        });
    }
};

/// A marker that was lost is not finite, or lies exactly at the origin.
void addMarkers(const wire::PointPositions& message, LengthUnit unit, const BodyOrigins& body,
                PoseEvidence& evidence) {
    constexpr double kOwnTolerance = 0.015;
    constexpr double kReferenceTolerance = 0.06;
    evidence.markerTolerance = body.points.empty() ? kReferenceTolerance : kOwnTolerance;
    const PointIdCoding coding = detectPointIdCoding(idsOf(message.points));
    for (const wire::Point& point : message.points) {
        const auto reference = decodePointId(coding, point.id);
        const Eigen::Vector3d place = pointFromYUp(point.position, unit);
        if (!reference || reference->segmentId < 1 || reference->segmentId > kBodySegmentCount ||
            !isPlace(place) || place.isZero(0)) {
            continue;
        }
        const int segment = reference->segmentId - 1;
        if (const auto local = body.pointOf(segment, reference->localId)) {
            evidence.markers[static_cast<std::size_t>(segment)].push_back({*local, place});
        }
    }
}

PoseEvidence evidenceOf(const CharacterPose& pose) {
    PoseEvidence evidence;
    for (std::size_t i = 0; i < std::min(pose.segments.size(), kBodySegments); ++i) {
        if (pose.sources[i].position != Provenance::None) {
            evidence.positions[i] = pose.segments[i].position;
        }
        if (pose.sources[i].orientation != Provenance::None) {
            evidence.orientations[i] = pose.segments[i].orientation;
        }
    }
    return evidence;
}

bool holdsAnything(const PoseEvidence& evidence) {
    const auto isThere = [](const auto& one) { return one.has_value(); };
    return std::ranges::any_of(evidence.positions, isThere) ||
           std::ranges::any_of(evidence.orientations, isThere) ||
           std::ranges::any_of(evidence.markers, [](const auto& list) { return !list.empty(); });
}

/// Solves the segments that were not sent from those that were; false if none was.
bool complete(const BodyOrigins& body, CharacterPose& pose) {
    const auto isWhole = [](const SegmentSource& source) { return source.weaker() != Provenance::None; };
    if (pose.isObjects || pose.sources.size() < kBodySegments ||
        std::all_of(pose.sources.begin(), pose.sources.begin() + kBodySegments, isWhole)) {
        return true;
    }
    const PoseEvidence evidence = evidenceOf(pose);
    if (!holdsAnything(evidence)) {
        return false;
    }
    const SolvedBody solved = solveBody(evidence, body);
    pose.isPlaceAssumed = solved.isPlaceAssumed;
    for (std::size_t i = 0; i < kBodySegments; ++i) {
        if (!isWhole(pose.sources[i])) {
            const bool isBroken = pose.sources[i].isBroken;
            pose.segments[i] = solved.segments[i];
            pose.sources[i] = solved.sources[i];
            pose.sources[i].isBroken = isBroken;
        }
    }
    return true;
}

/// Props, fingers and objects need both messages.
void takeOthers(const SentItems& sent, std::size_t first, CharacterPose& pose) {
    for (std::size_t i = first; i < pose.segments.size(); ++i) {
        if (sent.positions[i] && sent.orientations[i]) {
            pose.segments[i] = {*sent.positions[i], *sent.orientations[i]};
            pose.sources[i] = {Provenance::Sent, Provenance::Sent};
        }
    }
}

PoseEvidence::Before beforeOf(const CharacterPose& pose, double seconds) {
    PoseEvidence::Before before{{}, {}, seconds};
    for (std::size_t i = 0; i < kBodySegments; ++i) {
        before.orientations[i] = pose.segments[i].orientation;
        before.heldSeconds[i] = pose.sources[i].heldSeconds;
    }
    return before;
}

bool solve(std::span<const PosePart> parts, const BodyOrigins& body, const CharacterPose* before,
           double seconds, CharacterPose& pose) {
    SentItems sent;
    PoseEvidence evidence;
    if (before != nullptr && !before->isObjects && before->segments.size() >= kBodySegments) {
        evidence.before = beforeOf(*before, seconds);
    }
    for (const PosePart& part : parts) {
        const wire::Datagram& datagram = *part.datagram;
        if (const auto* linear = std::get_if<wire::LinearKinematics>(&datagram.body)) {
            sent.add(*linear, datagram.header, part.unit);
        } else if (const auto* angular = std::get_if<wire::AngularKinematics>(&datagram.body)) {
            sent.add(*angular, datagram.header);
        } else if (const auto* points = std::get_if<wire::PointPositions>(&datagram.body)) {
            addMarkers(*points, part.unit, body, evidence);
        } else {
            return false;
        }
    }
    prepare(pose, parts.front().datagram->header, sent.layout);
    pose.isObjects = sent.isObjects;
    pose.types.clear();
    for (const PosePart& part : parts) {
        pose.types.push_back(part.datagram->header.type());
    }
    if (pose.isObjects) {
        takeOthers(sent, 0, pose);
        return true;
    }
    std::copy_n(sent.positions.begin(), kBodySegments, evidence.positions.begin());
    std::copy_n(sent.orientations.begin(), kBodySegments, evidence.orientations.begin());
    if (!holdsAnything(evidence)) {
        return false;
    }
    const SolvedBody solved = solveBody(evidence, body);
    std::ranges::copy(solved.segments, pose.segments.begin());
    std::ranges::copy(solved.sources, pose.sources.begin());
    pose.isPlaceAssumed = solved.isPlaceAssumed;
    takeOthers(sent, kBodySegments, pose);
    return true;
}

} // namespace

void CharacterPose::move(const Eigen::Vector3d& way) {
    for (SegmentPose& segment : segments) {
        segment.position += way;
    }
    moved += way;
}

SegmentLayout segmentLayout(const wire::Header& header, std::size_t items) {
    if (header.countedSegments() == items && header.bodySegments != 0 && items <= wire::kMaxSegments) {
        return {header.bodySegments, header.props, header.fingerSegments};
    }
    const int count = static_cast<int>(std::min<std::size_t>(items, wire::kMaxSegments));
    const int body = std::min(count, kBodySegmentCount);
    const int rest = count - body;
    const int fingers = rest >= kFingerSegmentCount ? kFingerSegmentCount : 0;
    return {body, rest - fingers, fingers};
}

int ItemPlaces::positionOf(std::size_t item, std::optional<std::uint32_t> id) const {
    constexpr std::uint32_t kFootOfE = segment::kLeftFoot + 2;
    const int place = first ? *first + static_cast<int>(item) : -1;
    const bool isFootOfE = !isCounted && place == segment::kLeftFoot && id == kFootOfE;
    const bool isOfBody = id && *id >= 1 && *id <= static_cast<std::uint32_t>(kBodySegmentCount);
    return isOfBody && !isFootOfE && !isFromZero ? static_cast<int>(*id) - 1 : place;
}

ItemPlaces itemPlaces(const wire::Header& header, std::size_t items, std::optional<std::uint32_t> firstId) {
    const bool isFromZero = header.datagramIndex() == 0 && firstId == 0U;
    if (header.datagramIndex() == 0 && header.isLast()) {
        return {segmentLayout(header, items), 0, header.countedSegments() != 0, isFromZero};
    }
    std::optional<int> first;
    if (header.datagramIndex() == 0) {
        first = 0;
    } else if (firstId && *firstId >= 1 && *firstId <= static_cast<std::uint32_t>(kMaxSegmentCount)) {
        first = static_cast<int>(*firstId) - 1;
    }
    const std::size_t seen = static_cast<std::size_t>(first.value_or(0)) + items;
    return {segmentLayout(header, std::max<std::size_t>(seen, header.countedSegments())), first,
            header.countedSegments() != 0, isFromZero};
}

bool isOfObjects(const wire::Header& header, std::span<const std::uint32_t> ids) {
    constexpr std::size_t kMostUncounted = 8;
    const bool isCounted = header.countedSegments() == ids.size() && header.bodySegments != 0;
    const std::size_t count = isCounted ? header.bodySegments : ids.size();
    if (count == 0 || count >= kBodySegments || (!isCounted && count > kMostUncounted)) {
        return false;
    }
    return std::all_of(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count),
                       [count](std::uint32_t id) { return id <= count; });
}

bool hasWholePoses(std::uint8_t type) {
    return std::ranges::find(kWholePoseTypes, type) != kWholePoseTypes.end();
}

bool hasPoses(std::uint8_t type) {
    return std::ranges::find(kPoseTypes, type) != kPoseTypes.end();
}

bool poseFromMessage(const wire::Datagram& datagram, std::span<const Eigen::Vector3d> nullPose,
                     LengthUnit unit, CharacterPose& pose) {
    if (const auto* euler = std::get_if<wire::PoseEuler>(&datagram.body)) {
        return read(euler->segments, datagram.header, pose,
                    [unit](const auto& item) { return poseFromEuler(item, unit); });
    }
    if (const auto* quaternion = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
        return read(quaternion->segments, datagram.header, pose,
                    [unit](const auto& item) { return poseFromQuaternion(item, unit); });
    }
    if (const auto* unity = std::get_if<wire::PoseUnity>(&datagram.body)) {
        return readUnity(*unity, datagram.header, nullPose, unit, pose);
    }
    return false;
}

bool poseFromParts(std::span<const PosePart> parts, const BodyOrigins& body, const CharacterPose* before,
                   double seconds, CharacterPose& pose) {
    if (parts.empty()) {
        return false;
    }
    const wire::Datagram& first = *parts.front().datagram;
    if (!hasWholePoses(first.header.type())) {
        return solve(parts, body, before, seconds, pose);
    }
    return poseFromMessage(first, body.places, parts.front().unit, pose) && complete(body, pose);
}

} // namespace posewire::model
