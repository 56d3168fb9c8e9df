// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/points.h"
#include "core/wire/codec.h"

#include <optional>
#include <string_view>

/// The names of items, from the tables of segments, points and joints.
namespace posewire::model {

/// The point of an item in type 03, whose first point has the number `firstId`: the few numbers that could
/// be of either coding are taken as that is.
[[nodiscard]] PointReference pointReference(std::uint32_t id, std::uint32_t firstId);

/// How many of the points are markers. The tags that follow the last of them are not.
[[nodiscard]] std::size_t countMarkers(const wire::PointPositions& message);

/// Place of a row of type 20 in jointDefinitions() by the points of its ends; nothing if it has none. The
/// last rows, of which two have the same, are told apart by their places alone.
[[nodiscard]] std::optional<int> findJoint(std::uint32_t parent, std::uint32_t child);

/// Whether an item of types 01 and 02 is a MotionGrid tag in the place of a prop.
[[nodiscard]] bool isTag(const wire::Datagram& datagram, std::size_t item);

/// Number of the segment that an item is about, whatever the revision numbers it: body from 1, props, left
/// hand, right hand. 0 for none, and of types 11 and 13, whose items have names.
[[nodiscard]] int segmentOfItem(const wire::Datagram& datagram, std::size_t item);

/// "RightHand", "Prop1", "pSacrum", "jRightKnee" of the item at a place of types 01 to 03, 05, 10, and 20 to
/// 23; empty for one without a name, such as a tag.
[[nodiscard]] std::string_view itemName(const wire::Datagram& datagram, std::size_t item);

} // namespace posewire::model
