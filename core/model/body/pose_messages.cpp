// SPDX-License-Identifier: MIT
#include "core/model/body/pose_messages.h"

#include "core/model/body/item_names.h"
#include "core/wire/tags.h"

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
              const BodyOrigins& body, const CharacterPose* before, CharacterPose& pose) {
    std::array<PosePart, kPoseTypes.size()> parts{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (chosen[i] != nullptr) {
            parts[count++] = {&chosen[i]->datagram, units[i]};
        }
    }
    const Message* last = newestOf(chosen);
    if (last == nullptr) {
        return false;
    }
    const Message& newest = *last;
    constexpr double kMostApart = 0.5; // seconds
    const double seconds =
        before != nullptr ? std::chrono::duration<double>(newest.stamp - before->stamp).count() : 0;
    const bool isBefore = seconds > 0 && seconds < kMostApart;
    if (!poseFromParts(std::span(parts).first(count), body, isBefore ? before : nullptr, seconds, pose)) {
        return false;
    }
    pose.packet = newest.packet;
    pose.stamp = newest.stamp;
    if (pose.isPlaceAssumed) {
        constexpr double kApart = 1.0; // metres between characters in a row
        pose.move({0, kApart * newest.datagram.header.character, 0});
    }
    return true;
}

std::optional<std::size_t> rememberingPlace(const PoseMessages& chosen) {
    const auto isThere = [](const Message* one) { return one != nullptr; };
    const auto one = std::ranges::find_if(chosen, isThere);
    if (one == chosen.end() || std::ranges::count_if(chosen, isThere) != 1) {
        return std::nullopt;
    }
    const auto place = static_cast<std::size_t>(one - chosen.begin());
    const std::uint8_t type = kPoseTypes[place];
    const bool isIt = type == wire::LinearKinematics::kType || type == wire::PointPositions::kType;
    return isIt && (*one)->datagram.header.isLast() ? std::optional(place) : std::nullopt;
}

void addTags(const Message& message, LengthUnit unit, std::vector<TagPlace>& tags) {
    const auto put = [&](std::uint32_t id, const Eigen::Vector3d& position) {
        auto at = std::ranges::lower_bound(tags, id, {}, &TagPlace::id);
        const bool isKnown = at != tags.end() && at->id == id;
        if (!isPlace(position) || (!isKnown && tags.size() == wire::kMaxItems)) {
            return;
        }
        at = isKnown ? at : tags.insert(at, TagPlace{id});
        if (at->stamp <= message.stamp) {
            *at = {id, position, message.stamp};
        }
    };
    const auto putInPropPlaces = [&](const auto& items, auto toPose) {
        for (std::size_t i = kBodySegments; i < items.size(); ++i) {
            if (wire::isTag(message.datagram.header, items, i)) {
                put(items[i].id, toPose(items[i], unit).position);
            }
        }
    };
    const auto putFrom = [&](const std::vector<wire::Point>& points, std::size_t first) {
        for (std::size_t i = first; i < points.size(); ++i) {
            put(points[i].id, pointFromYUp(points[i].position, unit));
        }
    };
    const wire::Body& body = message.datagram.body;
    if (const auto* euler = std::get_if<wire::PoseEuler>(&body)) {
        putInPropPlaces(euler->segments, poseFromEuler);
    } else if (const auto* quaternion = std::get_if<wire::PoseQuaternion>(&body)) {
        putInPropPlaces(quaternion->segments, poseFromQuaternion);
    } else if (const auto* markers = std::get_if<wire::PointPositions>(&body)) {
        putFrom(markers->points, countMarkers(*markers));
    } else if (const auto* free = std::get_if<wire::TagPositions>(&body)) {
        putFrom(free->points, 0);
    }
}

} // namespace posewire::model
