// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/header.h"
#include "core/wire/messages.h"

#include <span>

/// Which segment an item of a message is about.
namespace posewire::filter {

/// Where an item stands.
struct ItemPlace {
    const wire::Header& header;
    std::size_t item;
    std::size_t items;
    bool isUnityOrder; ///< type 05 numbers the segments in an order of its own
};

template <class Item>
concept HasSegmentId = std::is_same_v<Item, wire::SegmentEuler> ||
    std::is_same_v<Item, wire::SegmentQuaternion> || std::is_same_v<Item, wire::SegmentScale> ||
    std::is_same_v<Item, wire::LinearSegment> || std::is_same_v<Item, wire::AngularSegment> ||
    std::is_same_v<Item, wire::Tracker> || std::is_same_v<Item, wire::Prop>;

/// The wire's own number; null-pose segments, which have no number, count from 1; a joint belongs to its
/// child.
template <HasSegmentId Item>
double segmentId(const Item& item, std::size_t) {
    return item.id;
}
inline double segmentId(const wire::Joint& joint, std::size_t) {
    return joint.child >> 8;
}
inline double segmentId(const wire::NullPoseSegment&, std::size_t item) {
    return static_cast<double>(item + 1);
}

/// Points are numbered 256 × segment + point, in revision E 100 × segment + point. The few ids that could be
/// either are taken as the first point of the datagram is.
[[nodiscard]] double pointSegment(std::span<const wire::Point> points, std::size_t item);

/// The number that a name stands for (see segmentNumber), since the ids of props and fingers differ between
/// revisions; 0 where the item has no name.
double namedSegment(std::uint32_t id, const ItemPlace& place);
double namedSegment(const wire::NullPoseSegment& segment, const ItemPlace& place);
template <class Item>
double namedSegment(const Item& item, const ItemPlace& place) {
    return namedSegment(static_cast<std::uint32_t>(segmentId(item, place.item)), place);
}

} // namespace posewire::filter
