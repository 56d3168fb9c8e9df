// SPDX-License-Identifier: MIT
#include "core/model/body/pose_remark.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace posewire::model {
namespace {

bool holds(const CharacterPose& pose, std::uint8_t type) {
    return std::ranges::find(pose.types, type) != pose.types.end();
}

words::Fact ofSegments(words::Kind kind, const CharacterPose& pose, const std::vector<int>& segments) {
    std::vector<std::string> names;
    for (const int segment : segments) {
        names.emplace_back(segmentTitle(pose.layout, segment));
    }
    return {kind, {{"segments", std::move(names)}}};
}

std::vector<int> segmentsWhere(const CharacterPose& pose, const auto& isSo) {
    std::vector<int> segments;
    for (std::size_t i = 0; i < std::min(pose.sources.size(), kBodySegments); ++i) {
        if (isSo(pose.sources[i])) {
            segments.push_back(static_cast<int>(i));
        }
    }
    return segments;
}

words::Kind partsKind(const CharacterPose& pose) {
    using enum words::Kind;
    const bool hasPositions = holds(pose, wire::LinearKinematics::kType);
    const bool hasOrientations = holds(pose, wire::AngularKinematics::kType);
    if (hasPositions && hasOrientations) {
        return Nothing;
    }
    if (!holds(pose, wire::PointPositions::kType)) {
        return hasOrientations ? NoPositions : NoOrientations;
    }
    if (hasOrientations) {
        return PositionsFitted;
    }
    return hasPositions ? OrientationsFitted : BodyFitted;
}

void addMissing(const CharacterPose& pose, PoseRemark& remark) {
    using enum words::Kind;
    const auto are = [&pose](Provenance provenance) {
        return segmentsWhere(pose, [provenance](const SegmentSource& source) {
            return source.weaker() == provenance && !source.isBroken;
        });
    };
    const auto assumed = are(Provenance::Assumed);
    const auto solved = are(Provenance::Solved);
    const auto broken = segmentsWhere(pose, [](const SegmentSource& source) { return source.isBroken; });
    if (!broken.empty()) {
        remark.lines.push_back(ofSegments(SegmentsBroken, pose, broken));
        remark.reason = remark.lines.back();
    }
    const bool isWhole = hasWholePoses(pose.type);
    // Type 05 is solved by design, and types in parts have said so.
    if (isWhole && pose.type != wire::PoseUnity::kType && !solved.empty()) {
        remark.lines.push_back(ofSegments(SegmentsSolved, pose, solved));
    }
    if (!assumed.empty() && !(pose.isPlaceAssumed && assumed.size() == 1)) {
        remark.lines.push_back(ofSegments(isWhole ? SegmentsAssumed : TurnsAssumed, pose, assumed));
        remark.reason = remark.reason.isNothing() ? remark.lines.back() : remark.reason;
    }
    // That a limb may be turned otherwise about itself is no doubt about a body that was fitted.
    const auto isDoubted = [](const SegmentSource& source) {
        return std::min(source.position, source.orientation) == Provenance::Assumed;
    };
    remark.isAssumed = !segmentsWhere(pose, isDoubted).empty() || !broken.empty() || pose.isPlaceAssumed;
    if (remark.isAssumed) {
        remark.brief = {PartlyAssumed};
    }
}

/// How long arms and legs are between the joints that were sent, against the body: the median of their bones,
/// since joints open; 1 where most are not known.
double limbScale(const CharacterPose& pose, const BodyOrigins& body) {
    using namespace segment;
    constexpr std::array kEnds{kRightForeArm,  kRightHand, kLeftForeArm,  kLeftHand,
                               kRightLowerLeg, kRightFoot, kLeftLowerLeg, kLeftFoot};
    const auto isSent = [&pose](std::size_t i) {
        return i < pose.sources.size() && pose.sources[i].position == Provenance::Sent;
    };
    std::vector<double> scales;
    for (const auto end : kEnds) {
        const auto to = static_cast<std::size_t>(end);
        const std::size_t from = parentOf(to);
        const double length = (body.places[to] - body.places[from]).norm();
        if (isSent(from) && isSent(to) && length > 0) {
            scales.push_back((pose.segments[to].position - pose.segments[from].position).norm() / length);
        }
    }
    if (2 * scales.size() <= kEnds.size()) {
        return 1;
    }
    const auto middle = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
    std::ranges::nth_element(scales, middle);
    return *middle;
}

/// A scale message that was lost or mixed up: the skin hangs on bones that the joints contradict.
void addContradiction(const CharacterPose& pose, const BodyOrigins& body, PoseRemark& remark) {
    const double scale = scaleInPose(pose, body);
    if (scale == 1) {
        return;
    }
    remark.lines.push_back({scale < 1 ? words::Kind::LongerThanScale : words::Kind::ShorterThanScale});
    remark.reason = remark.isAssumed ? remark.reason : remark.lines.back();
    remark.isAssumed = true;
    remark.brief = {words::Kind::WrongScale};
}

void addBody(const CharacterPose& pose, const BodyOrigins& body, PoseRemark& remark) {
    if (body.source == BodySource::NullPose) {
        addContradiction(pose, body, remark);
        return;
    }
    const bool isMeasured = body.source == BodySource::Poses;
    words::Fact line{isMeasured ? words::Kind::BonesMeasured : words::Kind::ReferenceBody};
    if (body.hasMeshScale) {
        words::set(line, "scale", words::Fact{words::Kind::MeshScale});
    }
    remark.lines.push_back(std::move(line));
    // Where positions are sent, the reference body is only what the skin hangs on. Markers are fitted to it.
    const bool isOfMarkers = holds(pose, wire::PointPositions::kType) &&
                             !holds(pose, wire::LinearKinematics::kType) && !hasWholePoses(pose.type);
    const bool restsOnBones = pose.type == wire::PoseUnity::kType || pose.isPlaceAssumed || isOfMarkers;
    if (!isMeasured && restsOnBones) {
        remark.isAssumed = true;
        remark.reason = remark.lines.back();
        remark.brief = {words::Kind::AssumedBody};
    }
}

} // namespace

double scaleInPose(const CharacterPose& pose, const BodyOrigins& body) {
    constexpr double kAnother = 1.08; // joints open by 1 %
    constexpr double kSteps = 50;
    const double scale = body.source == BodySource::NullPose ? limbScale(pose, body) : 1;
    return scale > 1 / kAnother && scale < kAnother ? 1 : std::round(scale * kSteps) / kSteps;
}

bool isBelowFloor(const CharacterPose& pose) {
    constexpr double kDeep = -0.3;
    return !pose.isObjects && std::ranges::any_of(pose.segments, [](const SegmentPose& segment) {
        return segment.position.z() < kDeep;
    });
}

PoseRemark remarkOn(const CharacterPose& pose, const BodyOrigins& body) {
    PoseRemark remark;
    if (pose.isObjects) {
        remark.brief = words::counted(words::Kind::Objects, pose.segments.size());
        remark.lines.push_back({words::Kind::TrackedObjects, {{"objects", remark.brief}}});
        return remark;
    }
    if (!hasWholePoses(pose.type)) {
        if (const words::Kind kind = partsKind(pose); kind != words::Kind::Nothing) {
            remark.lines.push_back({kind});
            remark.reason = remark.lines.back();
        }
    }
    addMissing(pose, remark);
    addBody(pose, body, remark);
    if (!remark.isAssumed) {
        remark.reason = {};
    }
    if (pose.isLifted) {
        remark.lines.push_back({words::Kind::PlacedOnFloor});
    } else if (isBelowFloor(pose)) {
        remark.lines.push_back({words::Kind::SentBelowFloor});
    }
    return remark;
}

} // namespace posewire::model
