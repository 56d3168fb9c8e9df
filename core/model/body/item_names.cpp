// SPDX-License-Identifier: MIT
#include "core/model/body/item_names.h"

#include "core/model/body/character_pose.h"
#include "core/model/body/joint_angles.h"
#include "core/wire/tags.h"

#include <algorithm>

namespace posewire::model {
namespace {

bool isOfBody(std::uint32_t id) {
    return id >= 1 && id <= kBodySegments;
}

template <class Item>
int numberOf(const wire::Header& header, const std::vector<Item>& items, std::size_t item) {
    const std::uint32_t id = items[item].id;
    if (header.type() == wire::PoseUnity::kType) {
        return isOfBody(id) ? unityOrder()[id - 1] + 1 : 0;
    }
    const ItemPlaces places = itemPlaces(header, items.size(), items.front().id);
    const auto at = placeOf(isOfBody(id) ? SegmentLayout() : places.layout, places.positionOf(item, id));
    return at && !wire::isTag(header, items, item) ? slotOf(*at) + 1 : 0;
}

} // namespace

PointReference pointReference(std::uint32_t id, std::uint32_t firstId) {
    using enum PointIdCoding;
    const auto by100 = knownPoint(By100, id);
    const bool isOld = by100 && (!knownPoint(By256, id) || !knownPoint(By256, firstId));
    return isOld ? *by100 : *decodePointId(By256, id);
}

std::size_t countMarkers(const wire::PointPositions& message) {
    std::vector<std::uint32_t> ids(message.points.size());
    std::ranges::transform(message.points, ids.begin(), &wire::Point::id);
    const PointIdCoding coding = detectPointIdCoding(ids);
    while (!ids.empty() && !knownPoint(coding, ids.back())) {
        ids.pop_back();
    }
    return ids.size();
}

std::optional<int> findJoint(std::uint32_t parent, std::uint32_t child) {
    constexpr auto kCoding = PointIdCoding::By256;
    const auto& joints = jointDefinitions();
    const auto found = std::ranges::find_if(joints, [&](const JointDefinition& joint) {
        return parent == encodePointId(kCoding, joint.parent) && child == encodePointId(kCoding, joint.child);
    });
    return found != joints.end() ? std::optional(static_cast<int>(found - joints.begin())) : std::nullopt;
}

bool isTag(const wire::Datagram& datagram, std::size_t item) {
    return std::visit(
        [&](const auto& message) {
            if constexpr (requires { message.segments[0].id; }) {
                return wire::isTag(datagram.header, message.segments, item);
            }
            return false;
        },
        datagram.body);
}

int segmentOfItem(const wire::Datagram& datagram, std::size_t item) {
    return std::visit(
        [&](const auto& message) -> int {
            if constexpr (requires { message.segments[0].id; }) {
                return numberOf(datagram.header, message.segments, item);
            } else if constexpr (requires { message.trackers[0].id; }) {
                return isOfBody(message.trackers[item].id) ? static_cast<int>(message.trackers[item].id) : 0;
            } else if constexpr (requires { message.joints[0].child; }) {
                const std::uint32_t child = message.joints[item].child >> 8;
                return isOfBody(child) ? static_cast<int>(child) : 0;
            } else if constexpr (requires { message.points[0].id; }) {
                return pointReference(message.points[item].id, message.points[0].id).segmentId;
            } else {
                return 0;
            }
        },
        datagram.body);
}

std::string_view itemName(const wire::Datagram& datagram, std::size_t item) {
    if (const auto* markers = std::get_if<wire::PointPositions>(&datagram.body)) {
        const auto reference = pointReference(markers->points[item].id, markers->points[0].id);
        const AnatomicalPoint* point = findPoint(reference.segmentId - 1, reference.localId);
        return point != nullptr ? point->name : std::string_view();
    }
    if (const auto* angles = std::get_if<wire::JointAngles>(&datagram.body)) {
        const bool isFirst = datagram.header.datagramIndex() == 0;
        const auto first =
            isFirst ? 0 : findJoint(angles->joints[0].parent, angles->joints[0].child).value_or(kJointCount);
        const std::size_t place = static_cast<std::size_t>(first) + item;
        return place < jointDefinitions().size() ? jointDefinitions()[place].name : std::string_view();
    }
    const bool isOfTags = std::holds_alternative<wire::TagPositions>(datagram.body);
    return isOfTags ? std::string_view() : segmentName(kAllSegments, segmentOfItem(datagram, item) - 1);
}

} // namespace posewire::model
