// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/body/provenance.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/segments.h"
#include "core/model/body/spaces.h"
#include "core/wire/codec.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace posewire::model {

/// Where a character's segments are at one sample, in the one frame above the wire (core/model/spaces.h).
struct CharacterPose {
    SegmentLayout layout;
    std::vector<SegmentPose> segments;  ///< by position in the datagram: body, props, left hand, right hand
    std::vector<SegmentSource> sources; ///< where each comes from
    std::uint8_t type = 0;              ///< the message type it was taken from, the most telling of several
    std::vector<std::uint8_t> types;    ///< all of them
    /// Tracked objects, each free in space: no body.
    bool isObjects = false;
    /// Nothing that was sent says where in the world it is.
    bool isPlaceAssumed = false;
    /// The operator has put it on the floor: it was sent below.
    bool isLifted = false;
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    std::uint32_t sample = 0;
    std::uint32_t timeCode = 0;
    log::Stamp stamp{};
    std::uint64_t packet = 0;

    /// Moves all of it, in metres.
    void move(const Eigen::Vector3d& way);
    /// False if there is no item at a position, or one that is not finite.
    [[nodiscard]] bool isPresent(std::size_t position) const {
        return position < sources.size() && sources[position].position != Provenance::None;
    }
};

/// Body, props and fingers of a pose datagram: from the header's counts where they add up to the items, else
/// from the number of items (older senders: 23 body segments, then props, then fingers).
[[nodiscard]] SegmentLayout segmentLayout(const wire::Header& header, std::size_t items);

/// Where the items of one datagram stand in their message, which may come in several.
struct ItemPlaces {
    SegmentLayout layout;       ///< of the whole message, as far as this datagram shows it
    std::optional<int> first{}; ///< place of the first item, the others follow; empty if it is not known
    bool isCounted = false;     ///< the header has counts, as those of newer senders do
    bool isFromZero = false;    ///< its IDs begin at 0, where they should at 1

    /// The one rule for which segment an item is about, as its position in a whole pose: an id of the body
    /// names its segment; props and fingers, and what has no id, go by place. Revision E gives the left foot
    /// the id of the left toe; where ids begin at 0 all go by place. -1 if nothing is known.
    [[nodiscard]] int positionOf(std::size_t item, std::optional<std::uint32_t> id) const;
};
/// The first datagram of a sample begins with the pelvis; a later one with what its first item's id names,
/// since ids count the items of the message from 1. `firstId` is empty where items have no such id, or it
/// plays no part.
[[nodiscard]] ItemPlaces itemPlaces(const wire::Header& header, std::size_t items,
                                    std::optional<std::uint32_t> firstId);

/// What a pose datagram is about: MVN sends tracked objects as a character of its own with fewer segments
/// than a body, numbered without a gap, and up to 8 of them where its header has no counts.
[[nodiscard]] bool isOfObjects(const wire::Header& header, std::span<const std::uint32_t> ids);

/// The ids of the items of a message, in its order.
template <class Items>
std::vector<std::uint32_t> idsOf(const Items& items) {
    std::vector<std::uint32_t> ids;
    ids.reserve(items.size());
    std::ranges::transform(items, std::back_inserter(ids), [](const auto& item) { return item.id; });
    return ids;
}

/// Pose from a message of type 01, 02 or 05, as sent; false for any other body. Items of the body are placed
/// by their IDs, the first of those that have the same; for type 05 by the Unity3D order, chained from the
/// pelvis by the relative positions on the wire, or, where these are not filled in, over `nullPose` (23
/// segment origins, metres). `unit` is what the sender's positions of this type are in.
[[nodiscard]] bool poseFromMessage(const wire::Datagram& datagram, std::span<const Eigen::Vector3d> nullPose,
                                   LengthUnit unit, CharacterPose& pose);

/// A message that a pose is taken from, with what its positions are in.
struct PosePart {
    const wire::Datagram* datagram = nullptr;
    LengthUnit unit = LengthUnit::Metre;
};

/// Types that hold positions and orientations of all segments, the one that is preferred first.
inline constexpr std::array<std::uint8_t, 3> kWholePoseTypes{wire::PoseQuaternion::kType,
                                                             wire::PoseEuler::kType, wire::PoseUnity::kType};
/// What is not older than the newest by more than this is sent together with it.
inline constexpr log::Duration kSentTogether = std::chrono::milliseconds(250);

/// Whether poses can be taken from messages of a type: 01, 02, 05; 21, 22, 03.
[[nodiscard]] bool hasPoses(std::uint8_t type);
[[nodiscard]] bool hasWholePoses(std::uint8_t type);

/// A whole pose from what was sent for one sample: one message of type 01, 02 or 05, or any of 21
/// (positions), 22 (orientations) and 03 (markers). What is missing of a body is solved (solveBody) with the
/// performer's own body and `before`, the pose of an earlier message of the same type and `seconds` ago, null
/// for none. False if the messages hold no pose, or nothing of one.
[[nodiscard]] bool poseFromParts(std::span<const PosePart> parts, const BodyOrigins& body,
                                 const CharacterPose* before, double seconds, CharacterPose& pose);

} // namespace posewire::model
