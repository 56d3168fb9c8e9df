// SPDX-License-Identifier: MIT
#pragma once

#include "core/field/field.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/segments.h"
#include "core/wire/layouts.h"

/// Which segment an item of a message is about, by what its fields refer to.
namespace posewire::field {

/// The numbers of an item that have to do with segments.
struct ItemIds {
    std::optional<std::uint32_t> segment{}; ///< as on the wire; of a joint that of its child
    std::optional<std::uint32_t> point{};
    std::optional<std::string_view> name{}; ///< of an item without a number
    bool isUnityOrder = false;
    bool isJoint = false;
};

template <wire::Form F, class Item>
ItemIds idsOf(const Item& item) {
    ItemIds ids;
    wire::forEachField<Item, F>([&]<class FieldType>(const FieldType& field) {
        using enum wire::RefersTo;
        using Member = wire::MemberValue<FieldType::kMember>;
        if constexpr (std::is_unsigned_v<Member>) {
            const std::uint32_t id = item.*FieldType::kMember;
            switch (field.about.refersTo) {
            case UnitySegment:
                ids.isUnityOrder = true;
                [[fallthrough]];
            case Segment:
            case Tracker:
            case Prop:
                ids.segment = id;
                break;
            case JointEnd:
                ids.segment = id >> 8;
                ids.isJoint = true;
                break;
            case Point:
                ids.point = id;
                break;
            default:
                break;
            }
        } else if constexpr (std::is_same_v<Member, std::string>) {
            ids.name = item.*FieldType::kMember;
        }
    });
    return ids;
}

/// Points are numbered 256 × segment + point, in revision E 100 × segment + point. The few ids that could be
/// either are taken as the first point of the datagram is.
[[nodiscard]] double pointSegment(std::uint32_t id, std::uint32_t firstId);

/// The number that a name means (see segmentNumber), since the ids of props and fingers differ between
/// revisions; 0 where the item has no name. `item`: its place in the datagram.
[[nodiscard]] double namedSegment(const ItemIds& ids, const model::ItemPlaces& places, std::size_t item);

/// The wire's own number; items without one count from 1.
template <wire::Form F, class Item>
double segmentNumberOf(const std::vector<Item>& items, std::size_t item) {
    const ItemIds ids = idsOf<F>(items[item]);
    if (ids.point) {
        return pointSegment(*ids.point, *idsOf<F>(items.front()).point);
    }
    return ids.segment ? *ids.segment : static_cast<double>(item + 1);
}

template <wire::Form F, class Item>
double namedSegment(const wire::Header& header, const std::vector<Item>& items, std::size_t item) {
    const ItemIds ids = idsOf<F>(items[item]);
    if (ids.point) {
        return segmentNumberOf<F>(items, item);
    }
    const auto places = model::itemPlaces(header, items.size(), idsOf<F>(items.front()).segment);
    return namedSegment(ids, places, item);
}

} // namespace posewire::field
