// SPDX-License-Identifier: MIT
#include "core/model/body/pose_messages.h"

#include <algorithm>
#include <span>

namespace posewire::model {
namespace {

constexpr std::size_t kWhole = kWholePoseTypes.size();
static_assert(std::equal(kWholePoseTypes.begin(), kWholePoseTypes.end(), kPoseTypes.begin()));
/// Samples that are searched for one that all types in parts have.
constexpr std::uint32_t kCommonSearch = 8;

/// Whether a message was sent together with a later one. A message of its sample may have come late.
bool isTogether(const Message& one, const Message& latest) {
    return one.stamp + kSentTogether >= latest.stamp ||
           one.datagram.header.sampleCounter == latest.datagram.header.sampleCounter;
}

const Message* wholePose(const PoseMessages& newest) {
    const Message* best = nullptr;
    for (std::size_t i = 0; i < kWhole; ++i) {
        if (newest[i] != nullptr && (best == nullptr || !isTogether(*best, *newest[i]))) {
            best = newest[i];
        }
    }
    return best;
}

/// Of `parts`, those of the newest sample that all have; else the first alone.
PoseMessages ofOneSample(const PoseMessages& parts, const Message& slowest, const FindPoseMessage& find) {
    std::uint32_t sample = slowest.datagram.header.sampleCounter;
    for (std::uint32_t step = 0; step < kCommonSearch; ++step, --sample) {
        PoseMessages common{};
        bool isCommon = true;
        for (std::size_t i = kWhole; isCommon && i < parts.size(); ++i) {
            if (parts[i] != nullptr) {
                const bool isIt = parts[i]->datagram.header.sampleCounter == sample;
                common[i] = isIt ? parts[i] : find(slowest.sender, i, sample);
                isCommon = common[i] != nullptr;
            }
        }
        if (isCommon) {
            return common;
        }
    }
    PoseMessages first{};
    const auto telling = std::ranges::find_if(parts, [](const Message* one) { return one != nullptr; });
    first[static_cast<std::size_t>(telling - parts.begin())] = *telling;
    return first;
}

/// A character whose place in the world is not known.
void standInRow(std::uint8_t character, CharacterPose& pose) {
    constexpr double kApart = 1.0; // metres
    pose.move({0, kApart * character, 0});
}

} // namespace

PoseMessages choosePose(const PoseMessages& newest, const FindPoseMessage& find) {
    PoseMessages parts{};
    const Message* latest = nullptr;
    for (std::size_t i = kWhole; i < newest.size(); ++i) {
        const bool isLater = newest[i] != nullptr && (latest == nullptr || newest[i]->stamp > latest->stamp);
        latest = isLater ? newest[i] : latest;
    }
    const Message* whole = wholePose(newest);
    if (whole != nullptr && (latest == nullptr || isTogether(*whole, *latest))) {
        PoseMessages chosen{};
        chosen[static_cast<std::size_t>(std::ranges::find(newest, whole) - newest.begin())] = whole;
        return chosen;
    }
    const Message* slowest = nullptr;
    for (std::size_t i = kWhole; i < newest.size(); ++i) {
        const Message* one = newest[i];
        if (one != nullptr && isTogether(*one, *latest)) {
            parts[i] = one;
            slowest = slowest == nullptr || one->stamp < slowest->stamp ? one : slowest;
        }
    }
    return slowest == nullptr ? parts : ofOneSample(parts, *slowest, find);
}

const Message* newestOf(const PoseMessages& chosen) {
    const Message* newest = nullptr;
    for (const Message* one : chosen) {
        newest = one != nullptr && (newest == nullptr || one->packet > newest->packet) ? one : newest;
    }
    return newest;
}

bool assemble(const PoseMessages& chosen, const std::array<LengthUnit, kPoseTypes.size()>& units,
              const BodyOrigins& body, CharacterPose& pose) {
    std::array<PosePart, kPoseTypes.size()> parts{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (chosen[i] != nullptr) {
            parts[count++] = {&chosen[i]->datagram, units[i]};
        }
    }
    if (!poseFromParts(std::span(parts).first(count), body, pose)) {
        return false;
    }
    const Message& newest = *newestOf(chosen);
    pose.packet = newest.packet;
    pose.stamp = newest.stamp;
    if (pose.isPlaceAssumed) {
        standInRow(newest.datagram.header.character, pose);
    }
    return true;
}

} // namespace posewire::model
