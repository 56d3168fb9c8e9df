// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_measures.h"
#include "core/model/body/pose_remark.h"
#include "core/model/body/pose_solver.h"
#include "core/model/session/decoded.h"

#include <algorithm>

namespace posewire::model {
namespace {

/// Datagrams of a stream that are searched for a sample.
constexpr std::size_t kSampleSearch = 64;

constexpr std::uint64_t kMeasured = std::uint64_t{1} << 63;

/// Raises the pelvis as high above the floor as it is above the soles: a figure without a floor has it at z =
/// 0.
void lift(const BodyOrigins& body, CharacterPose& pose) {
    pose.move({0, 0, body.places[segment::kPelvis].z() - body.floor});
    pose.isLifted = true;
}

} // namespace

/// A message among the newest kSampleSearch datagrams of its stream; null if its sample did not come whole.
const Message* Messages::messageOfSample(const CharacterKey& key, std::size_t place,
                                         std::uint32_t sample) const {
    const log::StreamEntries* stream = m_moment.entriesOf({key.sender, key.character, kPoseTypes[place]});
    const std::size_t count = stream != nullptr ? m_moment.countOf(*stream) : 0;
    for (std::size_t i = count; i-- > (count > kSampleSearch ? count - kSampleSearch : 0);) {
        if ((*stream)[i].sample != sample) {
            continue;
        }
        Decoded::OfStream& read = decoded().characters[key].parts[place];
        if (read.packet != (*stream)[i].packet ||
            read.message.isSentYUp != (m_roster.up(key.sender) == UpAxis::Y)) {
            read.isValid = readMessage(*stream, i + 1, read.message);
            read.packet = (*stream)[i].packet;
        }
        const bool isIt = read.isValid && read.message.datagram.header.sampleCounter == sample;
        return isIt ? &read.message : nullptr;
    }
    return nullptr;
}

/// Returns the pose of the message before `newest`, in kPoseTypes at `place`; null for none. Goes on from the
/// pose that was read last, if that is a little earlier.
const CharacterPose* Messages::poseBefore(const CharacterKey& key, std::size_t place, const Message& newest,
                                          const PoseOrigin& origin) const {
    constexpr std::size_t kMost = 1024;
    const std::uint8_t type = kPoseTypes[place];
    Decoded::OfCharacter& read = decoded().characters[key];
    const BodyOrigins& body = *read.origins;
    const log::Stamp from =
        newest.stamp - std::chrono::duration_cast<log::Duration>(std::chrono::duration<double>(kForgotten));
    const bool goesOn = read.isValid && read.pose.types == std::vector{type} && read.pose.stamp >= from &&
                        read.pose.stamp < newest.stamp && read.poseOrigin.isLike(origin);
    bool isBefore = goesOn;
    if (goesOn) {
        read.before = read.pose;
    }
    PoseMessages one{};
    visit({newest.sender, newest.datagram.header.character, type},
          goesOn ? read.pose.stamp + log::Duration(1) : from, kMost, [&](const Message& message) {
              one[place] = &message;
              if (message.packet < newest.packet &&
                  assemble(one, origin.units, body, isBefore ? &read.before : nullptr, read.next)) {
                  std::swap(read.before, read.next);
                  isBefore = true;
              }
          });
    return isBefore ? &read.before : nullptr;
}

const CharacterPose* Messages::pose(const CharacterKey& key) const {
    PoseMessages newest{};
    for (std::size_t i = 0; i < newest.size(); ++i) {
        newest[i] = message(key, kPoseTypes[i]);
    }
    const PoseMessages chosen =
        choosePose(newest, [&](log::SenderId sender, std::size_t place, std::uint32_t sample) {
            return messageOfSample({sender, key.character}, place, sample);
        });
    if (newestOf(chosen) == nullptr) {
        return nullptr;
    }
    const BodyOrigins& body = bodyOrigins(key);
    Decoded::OfCharacter& read = decoded().characters[key];
    PoseOrigin origin;
    origin.body = read.bodyOrigin;
    origin.isLifted = m_roster.isLifted(key);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (const Message* one = chosen[i]) {
            const Sender* sender = m_roster.find(one->sender);
            origin.packets[i] = one->packet + 1;
            origin.areYUp[i] = one->isSentYUp;
            origin.units[i] = sender != nullptr ? sender->positionUnit(kPoseTypes[i]) : LengthUnit::Metre;
        }
    }
    if (read.poseOrigin != origin) {
        const auto place = rememberingPlace(chosen);
        const CharacterPose* before = place ? poseBefore(key, *place, *chosen[*place], origin) : nullptr;
        read.isValid = assemble(chosen, origin.units, body, before, read.pose);
        if (read.isValid && origin.isLifted && isBelowFloor(read.pose)) {
            lift(body, read.pose);
        }
        read.poseOrigin = origin;
    }
    return read.isValid ? &read.pose : nullptr;
}

std::vector<TagPlace> Messages::tags(const CharacterKey& key) const {
    constexpr std::size_t kMost = 8192;
    const Sender* sender = m_roster.find(key.sender);
    if (sender == nullptr) {
        return {};
    }
    const log::StreamKey stream{key.sender, key.character, wire::TagPositions::kType};
    const log::StreamEntries* entries = m_moment.entriesOf(stream);
    const std::size_t count = entries != nullptr ? m_moment.countOf(*entries) : 0;
    const log::Stamp from = count > kMost ? (*entries)[count - kMost].stamp : log::Stamp();
    const LengthUnit unit = sender->positionUnit(wire::TagPositions::kType);
    Decoded::OfTags& known = decoded().characters[key].tags;
    if (count == 0 || (*entries)[count - 1].stamp < known.newest || unit != known.unit) {
        known = {unit};
    }
    visit(stream, std::max(from, known.newest), kMost, [&](const Message& message) {
        addTags(message, unit, known.places);
        known.newest = message.stamp;
    });
    std::erase_if(known.places, [from](const TagPlace& tag) { return tag.stamp < from; });
    std::vector<TagPlace> tags = known.places;
    for (const std::uint8_t type :
         {wire::PoseEuler::kType, wire::PoseQuaternion::kType, wire::PointPositions::kType}) {
        if (const Message* newest = message(key, type)) {
            addTags(*newest, sender->positionUnit(type), tags);
        }
    }
    return tags;
}

PoseRemark Messages::poseRemark(const CharacterKey& key) const {
    const CharacterPose* shown = pose(key);
    return shown != nullptr ? remarkOn(*shown, bodyOrigins(key)) : PoseRemark{};
}

const BodyOrigins& Messages::bodyOrigins(const CharacterKey& key) const {
    const NullPose* pose = nullPose(key);
    const Character* character = m_roster.find(key);
    const BodyMeasure* measure = pose == nullptr && character != nullptr ? &character->measuredBody : nullptr;
    const std::uint64_t origin = pose != nullptr      ? pose->packet
                                 : measure != nullptr ? kMeasured | measure->version()
                                                      : UINT64_MAX;
    Decoded::OfCharacter& read = decoded().characters[key];
    if (!read.origins || read.bodyOrigin != origin) {
        read.bodyOrigin = origin;
        const auto measured = measure != nullptr ? measure->body() : std::nullopt;
        read.origins = pose != nullptr ? bodyOf(*pose) : measured.value_or(BodyOrigins{referenceOrigins()});
    }
    read.origins->bends = character != nullptr ? character->bends.bends() : read.origins->bends;
    read.origins->hasMeshScale = message(key, wire::ScaleInformation::kType) != nullptr;
    return *read.origins;
}

} // namespace posewire::model
