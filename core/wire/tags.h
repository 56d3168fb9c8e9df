// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/header.h"
#include "core/wire/messages.h"

/// MotionGrid tags, points that are tracked by radio, in messages that are not theirs (E 2.5.1 to 2.5.3).
namespace posewire::wire {

/// Whether the item of a whole sample is a tag in the place of a prop. It is not turned and has the number of
/// no prop: 24 to 30 in revision E, and what its place is numbered.
template <class Item>
[[nodiscard]] bool isTag(const Header& header, const std::vector<Item>& items, std::size_t place) {
    constexpr std::size_t kBody = 23;
    constexpr std::size_t kWithFingers = kBody + 40;
    constexpr bool isEuler = std::is_same_v<Item, SegmentEuler>;
    if constexpr (isEuler || std::is_same_v<Item, SegmentQuaternion>) {
        const std::uint32_t id = items[place].id;
        const bool isProp = (id >= 24 && id <= 30) || id == place + 1 || id == place + 2;
        if (place < kBody || items.size() >= kWithFingers || isProp || items.front().id == 0 ||
            header.type() > PoseQuaternion::kType || header.countedSegments() != 0 ||
            header.datagramCounter != 0x80) {
            return false;
        }
        if constexpr (isEuler) {
            return items[place].rotation == Vec3{};
        } else {
            return items[place].orientation == Quat{1, 0, 0, 0};
        }
    }
    return false;
}

} // namespace posewire::wire
