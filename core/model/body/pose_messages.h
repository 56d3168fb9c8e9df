// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/character_pose.h"
#include "core/model/body/up_axis.h"
#include "core/model/message.h"

#include <array>
#include <functional>

/// Which messages make a pose, and the pose they make: the only place that decides. Viewport, verdict,
/// exports and comparisons draw on it, so a pose that is exported is the pose that is drawn.
namespace posewire::model {

/// Message types that hold poses: first those that hold whole ones (kWholePoseTypes), then those that are put
/// together; of each kind the most telling first.
inline constexpr std::array<std::uint8_t, 6> kPoseTypes{
    wire::PoseQuaternion::kType,   wire::PoseEuler::kType,         wire::PoseUnity::kType,
    wire::LinearKinematics::kType, wire::AngularKinematics::kType, wire::PointPositions::kType};

/// Makes a message Z-up that was just decoded.
inline void turnUpright(Message& message, UpAxis sent) {
    message.isSentYUp = sent == UpAxis::Y;
    if (message.isSentYUp) {
        turnBodyTo(UpAxis::Z, message.datagram.body);
    }
}

/// At most one message of each of kPoseTypes, in their order; null for none.
using PoseMessages = std::array<const Message*, kPoseTypes.size()>;

/// Finds an earlier message of a sender by its place in kPoseTypes and its sample; null if it did not come
/// whole or is forgotten.
using FindPoseMessage =
    std::function<const Message*(log::SenderId sender, std::size_t place, std::uint32_t sample)>;

/// The messages that make the pose at a moment, from the newest of each type by then.
///
/// A whole pose comes from type 02, 01 or 05: the first of these that is at most kSentTogether older than the
/// newest of them, so that a figure does not jump between types that are sent together. If none of them is on
/// the air, types 21, 22 and 03 of the newest sample that all of those on the air have make it; if there is
/// no such sample, the most telling of them makes it alone.
[[nodiscard]] PoseMessages choosePose(const PoseMessages& newest, const FindPoseMessage& find);

/// The message of a choice that was received last; null if it holds none.
[[nodiscard]] const Message* newestOf(const PoseMessages& chosen);

/// The pose that the chosen messages make, with the stamp and packet of the newest of them. `units` are what
/// their positions are in. Several characters without a known place stand side by side. False if the messages
/// hold no pose. `before` is the pose of an earlier message of the same type, for types that remember: null
/// for none.
bool assemble(const PoseMessages& chosen, const std::array<LengthUnit, kPoseTypes.size()>& units,
              const BodyOrigins& body, const CharacterPose* before, CharacterPose& pose);

/// The place in kPoseTypes of the one message of a choice, if its type says too little for a body to be known
/// without those before it: 21 or 03, in one datagram. Such a body is what its messages of the last
/// kForgotten seconds make it.
[[nodiscard]] std::optional<std::size_t> rememberingPlace(const PoseMessages& chosen);

/// A MotionGrid tag where a message had it last.
struct TagPlace {
    std::uint32_t id = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< metres, Z-up
    log::Stamp stamp{};
};

/// Brings the tags of a message of type 01 to 04 in, which is not older than what they hold: in the order of
/// their ids, at most as many as a message has items.
void addTags(const Message& message, LengthUnit unit, std::vector<TagPlace>& tags);

} // namespace posewire::model
