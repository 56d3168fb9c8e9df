// SPDX-License-Identifier: MIT
#include "core/model/body/character_pose.h"

#include <algorithm>

namespace posewire::model {
namespace {

constexpr std::size_t kBody = kBodySegmentCount;

void place(CharacterPose& pose, std::size_t index, const SegmentPose& segment) {
    if (index < pose.segments.size() && segment.position.allFinite() &&
        segment.orientation.coeffs().allFinite()) {
        pose.segments[index] = segment;
        pose.isPresent[index] = true;
    }
}

void prepare(CharacterPose& pose, const wire::Header& header, std::size_t items) {
    pose.layout = segmentLayout(header, items);
    pose.segments.assign(static_cast<std::size_t>(pose.layout.count()), {});
    pose.isPresent.assign(static_cast<std::size_t>(pose.layout.count()), false);
    pose.type = header.type();
    pose.sample = header.sampleCounter;
    pose.timeCode = header.timeCode;
}

/// Items in their order, each placed by `toPose(item)`.
template <class Items, class ToPose>
bool read(const Items& items, const wire::Header& header, CharacterPose& pose, ToPose toPose) {
    prepare(pose, header, items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        place(pose, i, toPose(items[i]));
    }
    return true;
}

/// Chains the local rotations from the pelvis outward over the null pose, parents before children.
bool readUnity(const wire::PoseUnity& message, const wire::Header& header,
               std::span<const Eigen::Vector3d> origins, LengthUnit unit, CharacterPose& pose) {
    prepare(pose, header, kBody);
    if (message.segments.size() < kBody || origins.size() < kBody) {
        return false;
    }
    const auto& places = unityPlaces();
    for (std::size_t i = 0; i < kBody; ++i) {
        const auto& item = message.segments[static_cast<std::size_t>(places[i])];
        const SegmentPose local = poseFromUnity(item, unit);
        const int parent = bodySegments()[i].parent;
        if (parent < 0) {
            place(pose, i, local);
            continue;
        }
        const auto from = static_cast<std::size_t>(parent);
        const SegmentPose bone{origins[i] - origins[from], local.orientation};
        place(pose, i, composed(pose.segments[from], bone));
    }
    return true;
}

} // namespace

SegmentLayout segmentLayout(const wire::Header& header, std::size_t items) {
    if (header.countedSegments() == items && header.bodySegments != 0) {
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
    return isOfBody && !isFootOfE ? static_cast<int>(*id) - 1 : place;
}

ItemPlaces itemPlaces(const wire::Header& header, std::size_t items, std::optional<std::uint32_t> firstId) {
    if (header.datagramIndex() == 0 && header.isLast()) {
        return {segmentLayout(header, items), 0, header.countedSegments() != 0};
    }
    std::optional<int> first;
    if (header.datagramIndex() == 0) {
        first = 0;
    } else if (firstId && *firstId >= 1 && *firstId <= static_cast<std::uint32_t>(kMaxSegmentCount)) {
        first = static_cast<int>(*firstId) - 1;
    }
    const std::size_t seen = static_cast<std::size_t>(first.value_or(0)) + items;
    return {segmentLayout(header, std::max<std::size_t>(seen, header.countedSegments())), first,
            header.countedSegments() != 0};
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

} // namespace posewire::model
