// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_findings.h"

#include "core/model/body/null_pose_measures.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/spaces.h"
#include "core/model/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

namespace posewire::model {
namespace {

using Findings = std::vector<NullPoseFinding>;

/// "Parts 2 and 3 of 6", "The last part".
std::string partsText(const NullPoseMessage& message) {
    const bool isOpen = message.partsExpected == 0;
    if (isOpen && message.missingParts.empty()) {
        return "The last part";
    }
    std::vector<std::string> names;
    for (const unsigned part : message.missingParts) {
        names.push_back(std::to_string(part + 1));
    }
    if (isOpen) {
        names.emplace_back("the last");
    }
    const std::string text = (names.size() == 1 ? "Part " : "Parts ") + listed(names);
    return isOpen ? text : text + " of " + std::to_string(message.partsExpected);
}

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
                {NullPoseFault::NameTwice, Severity::Error, findBodySegment(entry->first).value_or(-1),
                 "The name " + quoted(name.shown()) + " occurs twice: for segments " +
                     std::to_string(entry->second + 1) + " and " + std::to_string(place + 1) + ".",
                 "Receivers that go by names mix the two up; Posewire goes by the order."});
        }
    }
    if (twice > kMostNamed) {
        findings.push_back({NullPoseFault::NameTwice, Severity::Error, -1,
                            counted(twice - kMostNamed, "more segment has", "more segments have") +
                                " a name that occurred before.",
                            "Receivers that go by names mix them up; Posewire goes by the order."});
    }
}

void findUnknownNames(const NullPose& pose, Findings& findings) {
    std::vector<std::string> unknown;
    std::vector<std::string> respelled;
    for (std::size_t place = 0; place < std::min<std::size_t>(pose.segments.size(), kBodySegmentCount);
         ++place) {
        const ForeignText& name = pose.segments[place].name;
        if (!findBodySegment(name.exact())) {
            (isKnownApartFromSpelling(name.exact()) ? respelled : unknown)
                .push_back(std::to_string(place + 1) + " " + quoted(name.shown()));
        }
    }
    if (!unknown.empty()) {
        findings.push_back(
            {NullPoseFault::UnknownName, Severity::Warning, -1,
             counted(unknown.size(), "segment name") + (unknown.size() == 1 ? " is" : " are") +
                 " not in the specification: " + listed(unknown) + ".",
             "Posewire goes by the order of the segments; receivers that go by names lack these."});
    }
    if (!respelled.empty()) {
        findings.push_back({NullPoseFault::UnknownName, Severity::Note, -1,
                            counted(respelled.size(), "segment name") +
                                " spelled otherwise than in the specification: " + listed(respelled) + ".",
                            "Receivers that compare names letter by letter do not find these segments."});
    }
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
        findings.push_back(
            {NullPoseFault::ScaleAgainstNullPose, Severity::Warning, first,
             "Types 10 and 13 disagree: what is left of the null pose without the offsets of type 10 is "
             "no human body at " +
                 listed(apart) + ".",
             "One of the two belongs to another performer. Type 13 is used; type 10 is deprecated "
             "since revision J."});
    }
}

void findAboutParts(const NullPoseEvidence& evidence, Findings& findings) {
    const NullPoseMessage* newest = evidence.record.newest;
    const NullPose* pose = evidence.record.pose;
    const bool isWhole = pose != nullptr && pose->isComplete();
    if (newest != nullptr && !newest->isComplete() &&
        log::secondsOf(evidence.now - newest->stamp) >= kPartOverdue) {
        findings.push_back({NullPoseFault::MissingPart, isWhole ? Severity::Warning : Severity::Error, -1,
                            partsText(*newest) + " of the newest scale message never came; " +
                                counted(newest->partsReceived, "part") + " did.",
                            std::string(isWhole ? "What an earlier message said is shown. "
                                                : "Segments or points are missing below. ") +
                                "Parts get lost on the way, mostly where the network drops datagrams" +
                                (evidence.record.repetition > log::Duration::zero()
                                     ? "; the next message is due every " +
                                           fixedText(log::secondsOf(evidence.record.repetition), 1) + " s."
                                     : ".")});
    }
    if (evidence.record.incompleteMessages > 0) {
        findings.push_back(
            {NullPoseFault::EarlierPartMissing, isWhole ? Severity::Note : Severity::Warning, -1,
             counted(evidence.record.incompleteMessages, "earlier scale message") + " arrived incomplete.",
             isWhole ? "What is shown is complete."
                     : "Segments or points are missing below. Something between here and the sender "
                       "loses datagrams, or the sender leaves them out."});
    }
}

void findLeftOut(const NullPose& pose, Findings& findings) {
    if (pose.leftOut != 0) {
        findings.push_back({NullPoseFault::TooLarge, Severity::Error, -1,
                            counted(pose.leftOut, "segment or point was", "segments and points were") +
                                " left out: the scale message takes more than " +
                                std::to_string(NullPose::kMostBytes / 1024) + " KB.",
                            "MVN's take a tenth of it. Whatever sends this is not MVN."});
    }
}

void findAboutNames(const NullPoseEvidence& evidence, Findings& findings) {
    const NullPose& pose = *evidence.record.pose;
    findDuplicateNames(pose, findings);
    findUnknownNames(pose, findings);
    std::vector<std::string> moved;
    int first = -1;
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        const auto index = findBodySegment(pose.segments[place].name.exact());
        if (index && *index != static_cast<int>(place)) {
            first = moved.empty() ? *index : first;
            moved.push_back(pose.segments[place].title() + " at " + std::to_string(place + 1) +
                            " (should be " + std::to_string(*index + 1) + ")");
        }
    }
    if (!moved.empty()) {
        findings.push_back(
            {NullPoseFault::NameOrder, Severity::Warning, first,
             "The names come in another order than the specification's: " + listed(moved) + ".",
             "Receivers that go by the order put these origins on the wrong segments. Posewire goes by "
             "the names where all 23 are there once, else by the order."});
    }
    const auto& layout = evidence.layout;
    const auto count = static_cast<int>(pose.segments.size());
    if (layout && count != layout->body && count != layout->body + layout->props &&
        count != layout->count()) {
        findings.push_back(
            {NullPoseFault::SegmentCount, count < layout->body ? Severity::Error : Severity::Warning, -1,
             "The scale message has " + counted(static_cast<std::size_t>(count), "segment") +
                 ", the poses have " + std::to_string(layout->count()) + " (" + std::to_string(layout->body) +
                 " body, " + counted(static_cast<std::uint64_t>(layout->props), "prop") + ", " +
                 std::to_string(layout->fingers) + " fingers).",
             count < kBodySegmentCount ? "The figure is drawn with the reference body instead of this one."
                                       : "The origins of some segments of the poses are not known."});
    }
}

/// Scale messages of revision E (type 10), and none at all.
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

} // namespace

std::vector<NullPoseFinding> findContradictions(const NullPoseEvidence& evidence) {
    Findings findings;
    findAboutParts(evidence, findings);
    if (evidence.record.pose != nullptr) {
        findLeftOut(*evidence.record.pose, findings);
        findAboutNames(evidence, findings);
        findInShape(evidence.record, findings);
    }
    findAboutScale(evidence, findings);
    std::ranges::stable_sort(findings, std::ranges::greater(), &NullPoseFinding::severity);
    return findings;
}

std::string gravestError(const NullPoseRecord& record) {
    NullPoseEvidence alone; // of no time: no part is overdue
    alone.record = record;
    const Findings findings = findContradictions(alone);
    const bool isError = !findings.empty() && findings.front().severity == Severity::Error;
    return isError ? findings.front().what : std::string();
}

std::string findingsSummary(const std::vector<NullPoseFinding>& findings) {
    std::string text;
    for (const auto& [severity, noun] :
         {std::pair{Severity::Error, "error"}, std::pair{Severity::Warning, "warning"}}) {
        if (const auto found = std::ranges::count(findings, severity, &NullPoseFinding::severity)) {
            text += (text.empty() ? "" : ", ") + counted(static_cast<std::uint64_t>(found), noun);
        }
    }
    return text;
}

} // namespace posewire::model
