// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_findings.h"
#include "core/model/body/null_pose_measures.h"
#include "core/model/text.h"
#include "core/model/body/points.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/spaces.h"

#include <algorithm>
#include <cmath>

/// Scale messages of revision E (type 10), and none at all.
namespace posewire::model::contradictions {
namespace {

using Eigen::Vector3d;

/// How far the body that type 10 starts from may be from a human one.
constexpr double kDefaultTolerance = 0.15;

double determinant(const wire::Mat3& m) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
           m[2] * (m[3] * m[7] - m[4] * m[6]);
}

void findMatrices(const wire::ScaleInformation& scale, Findings& findings) {
    std::vector<std::string> bad;
    for (const wire::SegmentScale& segment : scale.segments) {
        const double volume = determinant(segment.matrix);
        if (!std::isfinite(volume) || volume <= 0 || !toVector(segment.offset).allFinite()) {
            bad.push_back(std::to_string(segment.id));
        }
    }
    if (!bad.empty()) {
        findings.push_back({NullPoseFault::ScaleAgainstNullPose, Severity::Warning, -1,
                            "Type 10 has no usable matrix or offset for " +
                                std::string(bad.size() == 1 ? "segment " : "segments ") + listed(bad) +
                                ": a scale must turn nothing inside out and leave some of it.",
                            "An avatar made from it loses these parts."});
    }
}

/// Null pose minus offset is the body that type 10 starts from. Which one MVN has is not published, but it
/// has to be a body: the reference one, scaled and moved.
void compareWithNullPose(const wire::ScaleInformation& scale, const NullPose& pose, Findings& findings) {
    const BodyPlaces places = bodyPlaces(pose);
    NullPose start;
    start.segments.resize(kBodySegmentCount);
    for (int index = 0; index < kBodySegmentCount; ++index) {
        const auto found =
            std::ranges::find(scale.segments, static_cast<std::uint32_t>(index + 1), &wire::SegmentScale::id);
        const auto origin = originOf(pose, places, index);
        if (found == scale.segments.end() || !origin) {
            return;
        }
        start.segments[static_cast<std::size_t>(index)].position = *origin - toVector(found->offset);
    }
    const auto height = measure(start).height;
    const Distances distances = height && *height > 0
                                    ? distancesToReference(start, *height)
                                    : Distances(start.segments.size(), Vector3d::Constant(1e9));
    std::vector<std::string> apart;
    int first = -1;
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (distances[i] && !(distances[i]->norm() <= kDefaultTolerance)) {
            first = first < 0 ? static_cast<int>(i) : first;
            apart.emplace_back(bodySegments()[i].displayName);
        }
    }
    if (!apart.empty()) {
        findings.push_back(
            {NullPoseFault::ScaleAgainstNullPose, Severity::Warning, first,
             "Types 10 and 13 disagree: what is left of the null pose without the offsets of type 10 is "
             "no human body at " +
                 listed(apart) + ".",
             "One of the two belongs to another performer. Type 13 is used; type 10 is deprecated "
             "since revision J."});
    }
}

} // namespace

void findAboutScale(const NullPoseEvidence& evidence, Findings& findings) {
    const NullPose* pose = evidence.record.pose;
    if (evidence.scale != nullptr) {
        findMatrices(*evidence.scale, findings);
        const std::size_t count = evidence.scale->segments.size();
        if (pose != nullptr && count != pose->segments.size()) {
            findings.push_back({NullPoseFault::ScaleAgainstNullPose, Severity::Note, -1,
                                "Type 10 has " + counted(count, "segment") + ", type 13 " +
                                    std::to_string(pose->segments.size()) + ".",
                                "Type 13 is used; type 10 is deprecated since revision J."});
        }
        if (pose != nullptr) {
            compareWithNullPose(*evidence.scale, *pose, findings);
        }
    }
    if (pose == nullptr && evidence.poseSeconds >= kScaleMessageDue) {
        const bool hasScale = evidence.scale != nullptr;
        findings.push_back({NullPoseFault::NeverSent, hasScale ? Severity::Note : Severity::Warning, -1,
                            hasScale
                                ? "Only type 10 was sent: it says how segments differ from a body that no "
                                  "specification describes."
                                : "Poses have come for " + fixedText(evidence.poseSeconds, 0) +
                                      " s and no scale message (type 13).",
                            "The figure has the size of the reference body, " +
                                fixedText(kReferenceStature, 2) + " m: feet may float, sink or slide."});
    }
}

} // namespace posewire::model::contradictions
