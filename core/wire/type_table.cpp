// SPDX-License-Identifier: MIT
#include "core/wire/type_table.h"

#include "core/wire/messages.h"

#include <array>

namespace posewire::wire {

template <>
constexpr TypeInfo kRow<PoseEuler>{PoseEuler::kType,
                                   "Pose, Euler",
                                   Frame::YUp,
                                   "E–N",
                                   "2.5.1",
                                   "Centimetres and degrees. The same data as type 02: (x, y, z) is 100 · "
                                   "(y, z, x) of it. Since N the fingers "
                                   "of both hands follow body and props.",
                                   true};
template <>
constexpr TypeInfo kRow<PoseQuaternion>{PoseQuaternion::kType,
                                        "Pose, quaternion",
                                        Frame::ZUp,
                                        "E–N",
                                        "2.5.2",
                                        "Metres on the wire, although the text says centimetres. The text "
                                        "also allows Y-up; no sender is known to use it.",
                                        true};
template <>
constexpr TypeInfo kRow<PointPositions>{PointPositions::kType,
                                        "Point positions",
                                        Frame::YUp,
                                        "E–N",
                                        "2.5.3",
                                        "Point IDs are 256 × segment + point, in older revisions 100 × "
                                        "segment + point. The text says 38 to 46 points; "
                                        "the usual set has 64.",
                                        true};
template <>
constexpr TypeInfo kRow<TagPositions>{TagPositions::kType,
                                      "Tag positions",
                                      Frame::YUp,
                                      "E",
                                      "E 2.5",
                                      "Only tags that were updated are sent. Deprecated since J. Newer "
                                      "programs use the number for a layout that is not published.",
                                      true};
template <>
constexpr TypeInfo kRow<PoseUnity>{
    PoseUnity::kType,
    "Pose, Unity3D",
    Frame::Unity,
    "F–N",
    "2.5.5",
    "The pelvis is global, all others are relative to their parents, in an order of their own. "
    "N says of props both that they are global and that they are not supported: here they are neither named "
    "nor drawn.",
    true};
template <>
constexpr TypeInfo kRow<ScaleInformation>{
    ScaleInformation::kType, "Scale (deprecated)", Frame::ZUp, "E", "E 2.6", "Replaced by type 13.", false};
template <>
constexpr TypeInfo kRow<PropInformation>{PropInformation::kType,
                                         "Props (deprecated)",
                                         Frame::None,
                                         "E",
                                         "E 2.6",
                                         "Names end with a zero byte. Replaced by type 13.",
                                         false};
template <>
constexpr TypeInfo kRow<MetaData>{
    MetaData::kType,
    "Metadata",
    Frame::None,
    "E–N",
    "2.6.3",
    "Real senders put a length before the text; revision E has the bare text. The tags count and timeOffset "
    "are not documented.",
    false};
template <>
constexpr TypeInfo kRow<NullPose>{
    NullPose::kType,
    "Null pose",
    Frame::ZUp,
    "J–N",
    "2.6.4",
    "Comes in several datagrams with sample counter 0: segments first, then points. Metres.",
    false};
template <>
constexpr TypeInfo kRow<JointAngles>{JointAngles::kType,
                                     "Joint angles",
                                     Frame::Isb,
                                     "J–N",
                                     "2.7.1",
                                     "22 joints in the text; real senders add 4 or 6 ergonomic angles (26 or "
                                     "28 items), two of which have the same "
                                     "pair of IDs. Angles are about the ISB axes of the joint, although the "
                                     "text names the axes of the segment.",
                                     true};
template <>
constexpr TypeInfo kRow<LinearKinematics>{
    LinearKinematics::kType, "Linear kinematics", Frame::ZUp, "J–N", "2.7.2", "", true};
template <>
constexpr TypeInfo kRow<AngularKinematics>{
    AngularKinematics::kType, "Angular kinematics", Frame::ZUp, "J–N", "2.7.3", "Radians per second.", true};
template <>
constexpr TypeInfo kRow<TrackerKinematics>{
    TrackerKinematics::kType,
    "Trackers",
    Frame::ZUp,
    "J–N",
    "2.7.4",
    "68 bytes an item on the wire; 44 in the text since M. The payload size tells.",
    true};
template <>
constexpr TypeInfo kRow<CentreOfMass>{CentreOfMass::kType,
                                      "Centre of mass",
                                      Frame::ZUp,
                                      "J–N",
                                      "2.7.5",
                                      "Recent senders add velocity and acceleration (36 bytes).",
                                      true};
template <>
constexpr TypeInfo kRow<TimeCode>{TimeCode::kType,
                                  "Time code",
                                  Frame::None,
                                  "J–N",
                                  "2.7.6",
                                  "Real senders put the length 12 before the text.",
                                  true};

namespace {

template <class... Message>
constexpr auto rowsOf(MessageList<Message...>) {
    return std::array{kRow<Message>...};
}
constexpr auto kTypes = rowsOf(Messages{});

} // namespace

std::span<const TypeInfo> typeTable() {
    return kTypes;
}

const TypeInfo* findType(std::uint8_t type) {
    for (const TypeInfo& row : kTypes) {
        if (row.type == type) {
            return &row;
        }
    }
    return nullptr;
}

std::string_view frameName(Frame frame) {
    constexpr std::array<std::string_view, 5> names{"", "Z-up, right-handed", "Y-up, right-handed",
                                                    "Y-up, left-handed", "ISB axes"};
    return names[static_cast<std::size_t>(frame)];
}

std::string typeDigits(std::uint8_t type) {
    return {static_cast<char>('0' + type / 10 % 10), static_cast<char>('0' + type % 10)};
}

std::string typeTitle(std::uint8_t type) {
    const TypeInfo* row = findType(type);
    return typeDigits(type) + ' ' + std::string(row != nullptr ? row->name : "unknown type");
}

bool isSampled(std::uint8_t type) {
    const TypeInfo* row = findType(type);
    return row == nullptr || row->isSampled;
}

} // namespace posewire::wire
