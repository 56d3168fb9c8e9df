// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/pose_messages.h"
#include "core/model/session/messages.h"

#include <array>
#include <map>
#include <optional>
#include <unordered_map>

namespace posewire::model {

struct Messages::PoseOrigin {
    std::array<std::uint64_t, kPoseTypes.size()> packets{}; ///< one past each; 0 for none
    std::array<LengthUnit, kPoseTypes.size()> units{};
    std::array<bool, kPoseTypes.size()> areYUp{};
    std::uint64_t body = UINT64_MAX;
    bool isLifted = false;

    friend bool operator==(const PoseOrigin&, const PoseOrigin&) = default;
    /// But for the packets.
    [[nodiscard]] bool isLike(const PoseOrigin& other) const {
        return units == other.units && areYUp == other.areYUp && body == other.body;
    }
};

/// Bounded by the streams and characters of the session; what is asked for again while the cursor is where it
/// was is not decoded again. For the implementation of Messages alone.
struct Messages::Decoded {
    struct OfStream {
        std::uint64_t packet = UINT64_MAX; ///< the newest datagram it was made from
        bool isValid = false;
        Message message;
    };
    struct OfTags {
        LengthUnit unit = LengthUnit::Centimetre;
        log::Stamp newest{}; ///< of the datagrams that were looked at
        std::vector<TagPlace> places{};
    };
    struct OfCharacter {
        PoseOrigin poseOrigin;
        bool isValid = false;
        CharacterPose pose;
        CharacterPose before; ///< of the message before, if `pose` is one that remembers
        CharacterPose next;   ///< while messages are followed
        std::array<OfStream, kPoseTypes.size()> parts; ///< of samples before the newest
        /// What the body was made of: the packet of a null pose, else how many poses it was measured on,
        /// with the highest bit.
        std::uint64_t bodyOrigin = UINT64_MAX;
        std::optional<BodyOrigins> origins;
        OfTags tags; ///< from type 04
    };
    std::unordered_map<log::StreamKey, OfStream> messages;
    std::map<CharacterKey, OfCharacter> characters;
    std::uint64_t retired = 0; ///< senders; where there are more, what is theirs goes
    std::uint64_t end = 0;     ///< of the session when it was looked at whether there is too much
    std::size_t bytes = 0;     ///< that were read since nothing was left
    Message part;
    Message visited;
};

} // namespace posewire::model
