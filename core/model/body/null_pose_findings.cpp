// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_findings.h"

#include "core/model/text.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace posewire::model {
namespace {

using contradictions::Findings;

double secondsSince(log::Stamp stamp, log::Stamp now) {
    return log::secondsOf(now - stamp);
}

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
    std::map<std::string, std::size_t> first;
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        const auto [entry, isNew] = first.try_emplace(pose.segments[place].name, place);
        if (!isNew) {
            findings.push_back(
                {NullPoseFault::NameTwice, Severity::Error, findBodySegment(entry->first).value_or(-1),
                 "The name " + quoted(entry->first) + " stands twice: for segments " +
                     std::to_string(entry->second + 1) + " and " + std::to_string(place + 1) + ".",
                 "Receivers that go by names mix the two up; Posewire goes by the order."});
        }
    }
}

void findUnknownNames(const NullPose& pose, Findings& findings) {
    std::vector<std::string> unknown;
    std::vector<std::string> respelled;
    for (std::size_t place = 0; place < std::min<std::size_t>(pose.segments.size(), kBodySegmentCount);
         ++place) {
        const std::string& name = pose.segments[place].name;
        if (!findBodySegment(name)) {
            (isKnownApartFromSpelling(name) ? respelled : unknown)
                .push_back(std::to_string(place + 1) + " " + quoted(name));
        }
    }
    if (!unknown.empty()) {
        findings.push_back(
            {NullPoseFault::UnknownName, Severity::Warning, -1,
             counted(unknown.size(), "segment name") +
                 " not in the specification: " + listed(unknown, kListed) + ".",
             "Posewire goes by the order of the segments; receivers that go by names lack these."});
    }
    if (!respelled.empty()) {
        findings.push_back(
            {NullPoseFault::UnknownName, Severity::Note, -1,
             counted(respelled.size(), "segment name") +
                 " spelled otherwise than in the specification: " + listed(respelled, kListed) + ".",
             "Receivers that compare names letter by letter do not find these segments."});
    }
}

} // namespace

namespace contradictions {

void findAboutParts(const NullPoseEvidence& evidence, Findings& findings) {
    const NullPoseMessage* newest = evidence.record.newest;
    const NullPose* pose = evidence.record.pose;
    if (newest != nullptr && !newest->isComplete() &&
        secondsSince(newest->stamp, evidence.now) >= kPartOverdue) {
        const bool hasWhole = pose != nullptr && pose->isComplete();
        findings.push_back(
            {NullPoseFault::MissingPart, hasWhole ? Severity::Warning : Severity::Error, -1,
             partsText(*newest) + " of the newest scale message never came; " +
                 counted(newest->partsReceived, "part") + " did.",
             std::string(hasWhole ? "What an earlier message said is shown. "
                                  : "Segments or points are missing below. ") +
                 "Parts get lost on the way, mostly where the network drops datagrams" +
                 (evidence.record.repetition > log::Duration::zero()
                      ? "; the next message is due every " + seconds(evidence.record.repetition) + "."
                      : ".")});
    }
    if (evidence.record.incompleteMessages > 0) {
        const bool isWhole = pose != nullptr && pose->isComplete();
        findings.push_back(
            {NullPoseFault::EarlierPartMissing, isWhole ? Severity::Note : Severity::Warning, -1,
             counted(evidence.record.incompleteMessages, "earlier scale message") +
                 " came without all parts.",
             isWhole ? "The network loses datagrams now and then; what is shown is whole."
                     : "Segments or points are missing below. Something between here and the sender "
                       "loses datagrams, or the sender leaves them out."});
    }
}

void findAboutNames(const NullPoseEvidence& evidence, Findings& findings) {
    const NullPose& pose = *evidence.record.pose;
    findDuplicateNames(pose, findings);
    findUnknownNames(pose, findings);
    std::vector<std::string> moved;
    int first = -1;
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        const auto index = findBodySegment(pose.segments[place].name);
        if (index && *index != static_cast<int>(place)) {
            first = moved.empty() ? *index : first;
            moved.push_back(pose.segments[place].name + " at " + std::to_string(place + 1) + " (should be " +
                            std::to_string(*index + 1) + ")");
        }
    }
    if (!moved.empty()) {
        findings.push_back(
            {NullPoseFault::NameOrder, Severity::Warning, first,
             "The names come in another order than the specification's: " + listed(moved, kListed) + ".",
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
                 " body, " + std::to_string(layout->props) + " props, " + std::to_string(layout->fingers) +
                 " fingers).",
             count < kBodySegmentCount ? "The figure is drawn with the reference body instead of this one."
                                       : "The origins of some segments of the poses are not known."});
    }
}

} // namespace contradictions

std::vector<NullPoseFinding> findContradictions(const NullPoseEvidence& evidence) {
    using namespace contradictions;
    Findings findings;
    findAboutParts(evidence, findings);
    if (const NullPose* pose = evidence.record.pose) {
        findAboutNames(evidence, findings);
        findAboutShape(*pose, findings);
        findAboutChange(evidence.record, findings);
        findAboutPoints(*pose, findings);
    }
    findAboutScale(evidence, findings);
    std::ranges::stable_sort(findings, std::ranges::greater(), &NullPoseFinding::severity);
    return findings;
}

std::string findingsSummary(const std::vector<NullPoseFinding>& findings) {
    const auto count = [&](Severity severity) {
        return static_cast<std::size_t>(std::ranges::count(findings, severity, &NullPoseFinding::severity));
    };
    std::vector<std::string> words;
    for (const auto& [severity, noun] :
         {std::pair{Severity::Error, "error"}, std::pair{Severity::Warning, "warning"}}) {
        if (const std::size_t found = count(severity)) {
            words.push_back(counted(found, noun));
        }
    }
    return words.empty() ? std::string() : words.size() == 1 ? words[0] : words[0] + ", " + words[1];
}

} // namespace posewire::model
