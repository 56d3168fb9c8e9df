// SPDX-License-Identifier: MIT
#include "core/field/item_segment.h"

#include "core/model/body/character_pose.h"
#include "core/model/body/points.h"
#include "core/model/body/segments.h"
#include "core/wire/text.h"

#include <algorithm>

namespace posewire::field {
namespace {

constexpr model::SegmentLayout kAll{model::kBodySegmentCount, model::kMaxPropCount,
                                    model::kFingerSegmentCount};

int numberAt(const model::SegmentPlace& place) {
    constexpr std::array<int, 4> kBefore{0, kAll.body, kAll.body + kAll.props,
                                         kAll.body + kAll.props + model::kHandSegmentCount};
    return kBefore[static_cast<std::size_t>(place.kind)] + place.index + 1;
}

/// In any case, and with spaces or without.
bool isSpelled(std::string_view known, std::string_view name) {
    for (const char letter : name) {
        if (letter == ' ') {
            continue;
        }
        if (known.empty() || wire::lower(known.front()) != wire::lower(letter)) {
            return false;
        }
        known.remove_prefix(1);
    }
    return known.empty();
}

} // namespace

double pointSegment(std::uint32_t id, std::uint32_t firstId) {
    using enum model::PointIdCoding;
    const auto by256 = model::knownPoint(By256, id);
    const auto by100 = model::knownPoint(By100, id);
    const bool isOld = by256 && by100 ? !model::knownPoint(By256, firstId) : by100.has_value();
    return isOld ? by100->segmentId : id >> 8;
}

std::span<const std::string_view> segmentNames() {
    static const auto names = [] {
        std::array<std::string_view, model::kMaxSegmentCount> all;
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i] = model::segmentName(kAll, static_cast<int>(i));
        }
        return all;
    }();
    return names;
}

std::optional<double> segmentNumber(std::string_view name) {
    const auto names = segmentNames();
    const auto found =
        std::ranges::find_if(names, [&](std::string_view known) { return isSpelled(known, name); });
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<double>(found - names.begin() + 1));
}

double namedSegment(const ItemIds& ids, const model::ItemPlaces& places, std::size_t item) {
    if (!ids.segment) {
        return ids.name ? segmentNumber(*ids.name).value_or(0) : 0;
    }
    const std::uint32_t id = *ids.segment;
    const bool isOfBody = id >= 1 && id <= model::kBodySegmentCount;
    if (ids.isUnityOrder) {
        return isOfBody ? model::unityOrder()[id - 1] + 1 : 0;
    }
    if (ids.isJoint) {
        return isOfBody ? id : 0;
    }
    const int position = places.positionOf(item, id);
    const auto at = model::placeOf(isOfBody ? model::SegmentLayout() : places.layout, position);
    return at ? numberAt(*at) : 0;
}

} // namespace posewire::field
