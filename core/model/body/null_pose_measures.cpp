// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_measures.h"

#include "core/model/body/points.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posewire::model {
namespace {

using Eigen::Vector3d;
using namespace segment;

/// From a segment's origin to the origin of another, or to a point.
struct LengthRow {
    std::string_view name;
    int from;
    int to;                 ///< −1: to the point
    std::string_view point; ///< of the right side
};

constexpr std::array<LengthRow, 15> kLengths{{
    {"Shoulder", kRightShoulder, kRightUpperArm, ""},
    {"Upper arm", kRightUpperArm, kRightForeArm, ""},
    {"Forearm", kRightForeArm, kRightHand, ""},
    {"Hand", kRightHand, -1, "pRightTopOfHand"},
    {"Hip", kPelvis, kRightUpperLeg, ""},
    {"Thigh", kRightUpperLeg, kRightLowerLeg, ""},
    {"Shank", kRightLowerLeg, kRightFoot, ""},
    {"Foot", kRightFoot, kRightToe, ""},
    {"Toe", kRightToe, -1, "pRightToe"},
    {"Pelvis to L5", kPelvis, kL5, ""},
    {"L5", kL5, kL3, ""},
    {"L3", kL3, kT12, ""},
    {"T12", kT12, kT8, ""},
    {"T8", kT8, kNeck, ""},
    {"Neck", kNeck, kHead, ""},
}};

std::string otherSide(std::string_view name) {
    std::string other(name);
    const auto at = other.find("Right");
    return at == std::string::npos ? other : other.replace(at, 5, "Left");
}

struct Body {
    const NullPose& pose;
    BodyPlaces places = bodyPlaces(pose);

    std::optional<Vector3d> origin(int index) const { return originOf(pose, places, index); }
    std::optional<double> length(const LengthRow& row, bool isLeft) const {
        const auto from = origin(isLeft ? mirrored(row.from) : row.from);
        const auto to = row.to >= 0 ? origin(isLeft ? mirrored(row.to) : row.to)
                                    : pointOf(pose, places, isLeft ? otherSide(row.point) : row.point);
        return from && to ? std::optional((*to - *from).norm()) : std::nullopt;
    }
};

bool isFoot(int bodySegment) {
    return bodySegment == kRightFoot || bodySegment == kRightToe || bodySegment == kLeftFoot ||
           bodySegment == kLeftToe;
}

/// Of a segment by its ID, which behind those of the body is its place; −1 for none.
int placeOf(const Body& body, int segmentId) {
    if (segmentId < 1 || segmentId > static_cast<int>(body.pose.segments.size())) {
        return -1;
    }
    return segmentId <= kBodySegmentCount ? body.places[static_cast<std::size_t>(segmentId - 1)]
                                          : segmentId - 1;
}

/// Without points of the feet, `soleDrop` below the lowest segment.
double floorOf(const Body& body, double soleDrop) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const NullPose::Segment& segment : body.pose.segments) {
        if (segment.position.allFinite()) {
            lowest = std::min(lowest, segment.position.z());
        }
    }
    for (const NullPose::Point& point : body.pose.points) {
        if (const int place = placeOf(body, point.segment); place >= 0) {
            soleDrop = isFoot(point.segment - 1) ? 0.0 : soleDrop;
            const NullPose::Segment& segment = body.pose.segments[static_cast<std::size_t>(place)];
            const double z = segment.position.z() + point.position.z();
            lowest = std::isfinite(z) ? std::min(lowest, z) : lowest;
        }
    }
    return std::isfinite(lowest) ? lowest - soleDrop : 0.0;
}

/// The ball of the lower foot.
std::optional<double> standOf(const Body& body) {
    std::optional<double> lowest;
    for (const int toe : {kRightToe, kLeftToe}) {
        if (const auto ball = body.origin(toe)) {
            lowest = std::min(lowest.value_or(ball->z()), ball->z());
        }
    }
    return lowest;
}

/// Height of the head's joint over the ball of the foot against that of the reference body.
std::optional<double> scaleOf(const Body& body) {
    static const ReferenceBody reference = makeReferenceBody();
    const auto head = body.origin(kHead);
    const auto stand = standOf(body);
    return head && stand ? std::optional((head->z() - *stand) / reference.nullPoseOrigin(kHead).z())
                         : std::nullopt;
}

void measureSpan(const Body& body, NullPoseMeasures& measures) {
    const auto right = pointOf(body.pose, body.places, "pRightTopOfHand");
    const auto left = pointOf(body.pose, body.places, "pLeftTopOfHand");
    const auto rightHand = body.origin(kRightHand);
    const auto leftHand = body.origin(kLeftHand);
    if (right && left) {
        measures.armSpan = (*left - *right).norm();
    } else if (rightHand && leftHand && measures.height) {
        const double hand = Eigen::Vector3d(findPoint("pRightTopOfHand")->reference.data()).norm();
        measures.armSpan = (*leftHand - *rightHand).norm() + 2 * hand * *measures.height / kReferenceStature;
        measures.isEstimated = true;
    }
}

} // namespace

BodyPlaces bodyPlaces(const NullPose& pose) {
    BodyPlaces byName;
    byName.fill(-1);
    BodyPlaces byOrder;
    byOrder.fill(-1);
    bool isNamed = true;
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        if (place < byOrder.size()) {
            byOrder[place] = static_cast<int>(place);
        }
        if (const auto index = findBodySegment(pose.segments[place].name.exact())) {
            int& named = byName[static_cast<std::size_t>(*index)];
            isNamed = isNamed && named < 0;
            named = static_cast<int>(place);
        }
    }
    isNamed = isNamed && std::ranges::none_of(byName, [](int place) { return place < 0; });
    return isNamed ? byName : byOrder;
}

int bodySegmentAt(const BodyPlaces& places, int place) {
    const auto found = std::ranges::find(places, place);
    return found == places.end() ? -1 : static_cast<int>(found - places.begin());
}

std::optional<Vector3d> originOf(const NullPose& pose, const BodyPlaces& places, int bodySegment) {
    const int place = places[static_cast<std::size_t>(bodySegment)];
    if (place < 0 || !pose.segments[static_cast<std::size_t>(place)].position.allFinite()) {
        return std::nullopt;
    }
    return pose.segments[static_cast<std::size_t>(place)].position;
}

std::optional<Vector3d> pointOf(const NullPose& pose, const BodyPlaces& places, std::string_view name) {
    for (const NullPose::Point& point : pose.points) {
        const bool hasSegment = point.segment >= 1 && point.segment <= kBodySegmentCount;
        const auto origin =
            hasSegment && point.name == name ? originOf(pose, places, point.segment - 1) : std::nullopt;
        if (origin && point.position.allFinite()) {
            return *origin + point.position;
        }
    }
    return std::nullopt;
}

std::optional<double> SegmentLength::difference() const {
    return rightMetres && leftMetres ? std::optional(*leftMetres - *rightMetres) : std::nullopt;
}

bool SegmentLength::isAsymmetric() const {
    return std::abs(difference().value_or(0.0)) >= kAsymmetryThreshold;
}

BodyOrigins bodyOf(const NullPose& pose) {
    BodyOrigins origins{referenceOrigins()};
    if (pose.segments.size() < origins.places.size()) {
        return origins;
    }
    const Body body{pose};
    for (std::size_t i = 0; i < origins.places.size(); ++i) {
        origins.places[i] = body.origin(static_cast<int>(i)).value_or(origins.places[i]);
    }
    for (const NullPose::Point& point : pose.points) {
        if (point.segment >= 1 && point.segment <= kBodySegmentCount && point.position.allFinite()) {
            origins.points.push_back({point.segment - 1, point.id, point.position});
        }
    }
    origins.floor = floorOf(body, kReferenceSoleDrop * scaleOf(body).value_or(1.0));
    origins.source = BodySource::NullPose;
    return origins;
}

NullPoseMeasures measure(const NullPose& pose) {
    const Body body{pose};
    NullPoseMeasures measures;
    const auto scale = scaleOf(body);
    measures.floor = floorOf(body, kReferenceSoleDrop * scale.value_or(1.0));
    if (const auto top = pointOf(body.pose, body.places, "pTopOfHead")) {
        measures.height = top->z() - measures.floor;
    } else if (scale) {
        measures.height = *scale * kReferenceStature;
        measures.isEstimated = true;
    }
    measureSpan(body, measures);
    for (const LengthRow& row : kLengths) {
        const bool hasSides = mirrored(row.from) != row.from || (row.to >= 0 && mirrored(row.to) != row.to);
        const int named = row.from == kPelvis && hasSides ? row.to : row.from;
        measures.lengths.push_back({row.name, named, hasSides ? mirrored(named) : -1, body.length(row, false),
                                    hasSides ? body.length(row, true) : std::nullopt});
    }
    return measures;
}

Distances distancesTo(const NullPose& pose, const NullPose& before) {
    Distances distances(pose.segments.size());
    const BodyPlaces now = bodyPlaces(pose);
    const BodyPlaces then = bodyPlaces(before);
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        const int index = bodySegmentAt(now, static_cast<int>(place));
        const int other = index >= 0 ? then[static_cast<std::size_t>(index)] : static_cast<int>(place);
        if (other >= 0 && static_cast<std::size_t>(other) < before.segments.size()) {
            distances[place] =
                pose.segments[place].position - before.segments[static_cast<std::size_t>(other)].position;
        }
    }
    return distances;
}

Distances distancesToReference(const NullPose& pose, double height) {
    Distances distances(pose.segments.size());
    const Body body{pose};
    const ReferenceBody reference = makeReferenceBody({.stature = height});
    const auto pelvis = body.origin(kPelvis);
    const auto stand = standOf(body);
    if (!pelvis || !stand) {
        return distances;
    }
    const Vector3d shift(pelvis->x(), pelvis->y(), *stand);
    for (int index = 0; index < kBodySegmentCount; ++index) {
        if (const auto origin = body.origin(index)) {
            distances[static_cast<std::size_t>(body.places[static_cast<std::size_t>(index)])] =
                *origin - (reference.nullPoseOrigin(index) + shift);
        }
    }
    return distances;
}

} // namespace posewire::model
