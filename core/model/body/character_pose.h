// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/body/segments.h"
#include "core/model/body/spaces.h"
#include "core/wire/codec.h"

#include <span>
#include <vector>

namespace posewire::model {

/// Where a character's segments are at one sample, in the one frame above the wire (core/model/spaces.h).
struct CharacterPose {
    SegmentLayout layout;
    std::vector<SegmentPose> segments; ///< by position in the datagram: body, props, left hand, right hand
    std::vector<bool> isPresent;       ///< false where the datagram had no item, or one that is not finite
    std::uint8_t type = 0;             ///< the message type it was taken from
    std::uint32_t sample = 0;
    std::uint32_t timeCode = 0;
    log::Stamp stamp{};
    std::uint64_t packet = 0;
};

/// Body, props and fingers of a pose datagram: from the header's counts where they add up to the items, else
/// from the number of items (older senders: 23 body segments, then props, then fingers).
[[nodiscard]] SegmentLayout segmentLayout(const wire::Header& header, std::size_t items);

/// Where the items of one datagram stand in their message, which may come in several.
struct ItemPlaces {
    SegmentLayout layout;       ///< of the whole message, as far as this datagram shows it
    std::optional<int> first{}; ///< place of the first item, the others follow; empty where it is not known
    bool isCounted = false;     ///< the header has counts, as those of newer senders do

    /// The one rule for which segment an item is about, as its position in a whole pose: an id of the body
    /// names its segment; props and fingers, and what has no id, go by place. Revision E gives the left foot
    /// the id of the left toe. -1 where nothing is known.
    [[nodiscard]] int positionOf(std::size_t item, std::optional<std::uint32_t> id) const;
};
/// The first datagram of a sample begins with the pelvis; a later one with what its first item's id names,
/// since ids count the items of the message from 1. `firstId` is empty where items have no such id.
[[nodiscard]] ItemPlaces itemPlaces(const wire::Header& header, std::size_t items,
                                    std::optional<std::uint32_t> firstId);

/// Pose from a message of type 01, 02 or 05; false for any other body. Items are placed by their position in
/// the datagram; for type 05 by the Unity3D order, chained from the pelvis over `nullPose` (23 segment
/// origins, metres), since wire positions of that type are relative and not always filled in.
/// `unit` is what the sender's positions of this type are in.
[[nodiscard]] bool poseFromMessage(const wire::Datagram& datagram, std::span<const Eigen::Vector3d> nullPose,
                                   LengthUnit unit, CharacterPose& pose);

} // namespace posewire::model
