// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_findings.h"

#include "core/model/body/null_pose_measures.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/spaces.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

namespace posewire::model {
namespace {

using Findings = std::vector<NullPoseFinding>;
using words::counted;
using words::Fact;
using K = words::Kind;

/// "rightupperarm" for "Right Upper Arm".
std::string letters(std::string_view name) {
    std::string kept;
    for (const char letter : name) {
        if (std::isalnum(static_cast<unsigned char>(letter)) != 0) {
            kept += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
        }
    }
    return kept;
}

bool isKnownApartFromSpelling(std::string_view name) {
    return std::ranges::any_of(bodySegments(), [wanted = letters(name)](const Segment& segment) {
        return letters(segment.name) == wanted;
    });
}

void findDuplicateNames(const NullPose& pose, Findings& findings) {
    constexpr std::size_t kMostNamed = 8;
    std::size_t twice = 0;
    std::map<std::string, std::size_t, std::less<>> first;
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        const ForeignText& name = pose.segments[place].name;
        const auto [entry, isNew] = first.try_emplace(std::string(name.exact()), place);
        if (!isNew && ++twice <= kMostNamed) {
            findings.push_back(
                {{K::NameTwice, {{"name", name.shown()}, {"from", entry->second + 1}, {"to", place + 1}}},
                 findBodySegment(entry->first).value_or(-1)});
        }
    }
    if (twice > kMostNamed) {
        findings.push_back({counted(K::MoreNamesTwice, twice - kMostNamed)});
    }
}

void findUnknownNames(const NullPose& pose, Findings& findings) {
    std::vector<Fact> unknown;
    std::vector<Fact> respelled;
    for (std::size_t place = 0; place < std::min<std::size_t>(pose.segments.size(), kBodySegmentCount);
         ++place) {
        const ForeignText& name = pose.segments[place].name;
        if (!findBodySegment(name.exact())) {
            (isKnownApartFromSpelling(name.exact()) ? respelled : unknown)
                .push_back({K::Numbered, {{"n", place + 1}, {"name", name.shown()}}});
        }
    }
    addListed(K::NamesUnknown, std::move(unknown), -1, findings);
    addListed(K::NamesRespelled, std::move(respelled), -1, findings);
}

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
        findings.push_back({{K::MatricesUnusable, {{"segments", std::move(bad)}}}});
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
                                    : Distances(start.segments.size(), Eigen::Vector3d::Constant(1e9));
    std::vector<std::string> apart;
    int first = -1;
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (distances[i] && !(distances[i]->norm() <= kDefaultTolerance)) {
            first = first < 0 ? static_cast<int>(i) : first;
            apart.emplace_back(bodySegments()[i].displayName);
        }
    }
    if (!apart.empty()) {
        findings.push_back({{K::ScalesDisagree, {{"segments", std::move(apart)}}}, first});
    }
}

/// "Parts 2 and 3 of 6" are missing, or "The last part".
Fact missingParts(const NullPoseEvidence& evidence, const NullPoseMessage& newest, bool isWhole) {
    const std::uint64_t received = newest.partsReceived;
    Fact fact{isWhole ? K::PartsMissingNow : K::PartsMissing, {{"count", counted(K::Parts, received)}}};
    std::vector<Fact> parts;
    for (const unsigned part : newest.missingParts) {
        parts.push_back({K::Text, {{"text", std::to_string(part + 1)}}});
    }
    if (newest.partsExpected != 0) {
        words::set(fact, "all", std::uint64_t{newest.partsExpected});
    } else if (!parts.empty()) {
        parts.push_back(K::LastPart);
    }
    words::set(fact, "parts", std::move(parts));
    if (evidence.record.repetition > log::Duration::zero()) {
        words::set(fact, "seconds", words::Number{log::secondsOf(evidence.record.repetition), 1});
    }
    return fact;
}

void findAboutParts(const NullPoseEvidence& evidence, Findings& findings) {
    const NullPoseMessage* newest = evidence.record.newest;
    const NullPose* pose = evidence.record.pose;
    const bool isWhole = pose != nullptr && pose->isComplete();
    if (newest != nullptr && !newest->isComplete() &&
        log::secondsOf(evidence.now - newest->stamp) >= kPartOverdue) {
        findings.push_back({missingParts(evidence, *newest, isWhole)});
    }
    if (evidence.record.incompleteMessages > 0) {
        findings.push_back({counted(isWhole ? K::EarlierPartsMissed : K::EarlierPartsMissing,
                                    evidence.record.incompleteMessages)});
    }
}

void findAboutNames(const NullPoseEvidence& evidence, Findings& findings) {
    const NullPose& pose = *evidence.record.pose;
    findDuplicateNames(pose, findings);
    findUnknownNames(pose, findings);
    std::vector<Fact> moved;
    int first = -1;
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        const auto index = findBodySegment(pose.segments[place].name.exact());
        if (index && *index != static_cast<int>(place)) {
            first = moved.empty() ? *index : first;
            moved.push_back({K::MovedTo,
                             {{"name", pose.segments[place].title()},
                              {"n", place + 1},
                              {"to", static_cast<std::uint64_t>(*index + 1)}}});
        }
    }
    addListed(K::NamesMoved, std::move(moved), first, findings);
    const auto& layout = evidence.layout;
    const auto count = static_cast<int>(pose.segments.size());
    if (layout && count != layout->body && count != layout->body + layout->props &&
        count != layout->count()) {
        const auto number = [](int value) { return static_cast<std::uint64_t>(value); };
        findings.push_back({{count < layout->body ? K::FewerSegments : K::MoreSegments,
                             {{"count", counted(K::Segments, number(count))},
                              {"all", number(layout->count())},
                              {"body", number(layout->body)},
                              {"props", counted(K::Props, number(layout->props))},
                              {"fingers", number(layout->fingers)}}}});
    }
}

/// Scale messages of revision E (type 10), and none at all.
void findAboutScale(const NullPoseEvidence& evidence, Findings& findings) {
    const NullPose* pose = evidence.record.pose;
    if (evidence.scale != nullptr) {
        findMatrices(*evidence.scale, findings);
        const std::size_t count = evidence.scale->segments.size();
        if (pose != nullptr && count != pose->segments.size()) {
            findings.push_back(
                {{K::ScalesDiffer,
                  {{"count", counted(K::Segments, count)}, {"all", std::uint64_t{pose->segments.size()}}}}});
        }
        if (pose != nullptr) {
            compareWithNullPose(*evidence.scale, *pose, findings);
        }
    }
    if (pose == nullptr && (evidence.scale != nullptr || evidence.poseSeconds >= kScaleMessageDue)) {
        findings.push_back({{evidence.scale != nullptr ? K::DeprecatedScaleAlone : K::NoScaleMessage,
                             {{"lasted", words::Number{evidence.poseSeconds}},
                              {"height", words::Number{kReferenceStature, 2}}}}});
    }
}

} // namespace

std::vector<NullPoseFinding> findContradictions(const NullPoseEvidence& evidence) {
    Findings findings;
    findAboutParts(evidence, findings);
    if (evidence.record.pose != nullptr) {
        if (const std::uint64_t leftOut = evidence.record.pose->leftOut; leftOut != 0) {
            findings.push_back(
                {{K::TooLarge, {{"n", leftOut}, {"limit", std::uint64_t{NullPose::kMostBytes / 1024}}}}});
        }
        findAboutNames(evidence, findings);
        findInShape(evidence.record, findings);
    }
    findAboutScale(evidence, findings);
    std::ranges::stable_sort(findings, std::ranges::greater(), &NullPoseFinding::severity);
    return findings;
}

std::optional<Fact> gravestError(const NullPoseRecord& record) {
    NullPoseEvidence alone; // of no time: no part is overdue
    alone.record = record;
    Findings findings = findContradictions(alone);
    const bool isError = !findings.empty() && findings.front().severity() == Severity::Error;
    return isError ? std::optional(std::move(findings.front().fact)) : std::nullopt;
}

Severity NullPoseFinding::severity() const {
    return fact.kind <= K::NotNumbers       ? Severity::Error
           : fact.kind <= K::LengthsChanged ? Severity::Warning
                                            : Severity::Note;
}

void addListed(K kind, std::vector<Fact> names, int segment, Findings& findings) {
    if (!names.empty()) {
        const std::uint64_t count = names.size();
        findings.push_back({{kind, {{"n", count}, {"names", std::move(names)}}}, segment});
    }
}

} // namespace posewire::model
