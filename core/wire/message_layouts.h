// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/header.h"
#include "core/wire/item_layouts.h"
#include "core/wire/messages.h"

/// How the header and the messages stand on the wire.
namespace posewire::wire {

inline constexpr std::array<FieldPart, 2> kIdParts{{
    {"magic", "", Unit::None, "every datagram begins with MXTP", 0, 4},
    {"type", "type", Unit::Identifier, "message type", 4, 2},
}};
inline constexpr std::array<FieldPart, 2> kCounterParts{{
    {"index", "datagram", Unit::Count, "place among the datagrams of the sample, bits 0 to 6", 0, 1, 0x7f},
    {"last", "last", Unit::None, "the last datagram of its sample, bit 7", 0, 1, 0x80},
}};

template <>
struct Layout<Header> {
    static constexpr auto fields = std::tuple{
        Field<&Header::id>{{"id", Unit::None, "\"MXTP\" and the message type as two digits", "2.4.1.1",
                            RefersTo::Nothing, kIdParts}},
        Field<&Header::sampleCounter>{
            {"sample", Unit::Count, "counts sampled frames; shared by all types of a frame", "2.4.1.2"}},
        Field<&Header::datagramCounter>{{"datagramCounter", Unit::None,
                                         "index of the datagram in its sample; bit 7 marks the last",
                                         "2.4.1.3", RefersTo::Nothing, kCounterParts}},
        Field<&Header::items>{{"items", Unit::Count, "segments or points in this datagram", "2.4.1.4"}},
        Field<&Header::timeCode>{
            {"timeCode", Unit::Milliseconds,
             "clock of the sender: since the start of a recording, or time of day when live", "2.4.1.5"}},
        Field<&Header::character>{{"character", Unit::Identifier,
                                   "which character the data belong to, from 0", "2.4.1.6",
                                   RefersTo::Character}},
        Field<&Header::bodySegments>{
            {"bodySegments", Unit::Count, "body segments; reserved and 0 before MVN 2019", "2.4.1.7"}},
        Field<&Header::props>{{"props", Unit::Count, "props; reserved and 0 before MVN 2019", "2.4.1.7"}},
        Field<&Header::fingerSegments>{{"fingerSegments", Unit::Count,
                                        "finger segments of both hands; reserved and 0 before MVN 2019",
                                        "2.4.1.7"}},
        Field<&Header::reserved>{{"reserved", Unit::Reserved, "reserved, 0", "2.4.1.7"}},
        Field<&Header::payloadSize>{{"payloadSize", Unit::ByteCount,
                                     "bytes after the header; reserved and 0 for older senders", "2.4.1.7"}},
    };
};
static_assert(kWireSize<Header> == kHeaderSize);

template <>
struct Layout<PoseEuler> {
    static constexpr auto fields = std::tuple{Items<&PoseEuler::segments>{
        {"segments", Unit::None, "body, then props", "2.5.1", RefersTo::Segment}}};
};
template <>
struct Layout<PoseQuaternion> {
    static constexpr auto fields = std::tuple{Items<&PoseQuaternion::segments>{
        {"segments", Unit::None, "body, props, left hand, right hand", "2.5.2", RefersTo::Segment}}};
};
template <>
struct Layout<PointPositions> {
    static constexpr auto fields = std::tuple{Items<&PointPositions::points>{
        {"points", Unit::None, "markers, then tags", "2.5.3", RefersTo::Point}}};
};
template <>
struct Layout<TagPositions> {
    static constexpr auto fields = std::tuple{Items<&TagPositions::points>{
        {"points", Unit::None, "tags that no character has", "E 2.5", RefersTo::Tag}}};
};
template <>
struct Layout<PoseUnity> {
    static constexpr auto fields = std::tuple{Items<&PoseUnity::segments, Form::Unity>{
        {"segments", Unit::None, "23 segments in the Unity3D order", "2.5.5", RefersTo::UnitySegment}}};
};
template <>
struct Layout<ScaleInformation> {
    static constexpr auto fields = std::tuple{Items<&ScaleInformation::segments>{
        {"segments", Unit::None, "scale of each segment of the mesh", "E 2.6", RefersTo::Segment}}};
};
template <>
struct Layout<PropInformation> {
    static constexpr auto fields = std::tuple{Items<&PropInformation::props>{
        {"props", Unit::None, "the props in use; none when empty", "E 2.6", RefersTo::Prop}}};
};
template <>
struct Layout<MetaData> {
    static constexpr auto fields = std::tuple{Text<&MetaData::text, TextKind::Prefixed>{
        {"text", Unit::TagLines, "one \"tag:value\" a line", "2.6.3"}}};
};
template <>
struct Layout<MetaData, Form::Bare> {
    static constexpr auto isStandard = &MetaData::hasLengthPrefix;
    static constexpr auto fields = std::tuple{Text<&MetaData::text, TextKind::ToEnd>{
        {"text", Unit::TagLines, "one \"tag:value\" a line", "E 2.6"}}};
};
template <>
struct Layout<NullPose> {
    static constexpr auto fields = std::tuple{
        CountedList<&NullPose::segments, kMaxNullPoseSegments>{
            {"segments", Unit::None, "null pose: a T-pose with all orientations identity", "2.6.4",
             RefersTo::Segment}},
        CountedList<&NullPose::points, kMaxNullPosePoints>{
            {"points", Unit::None, "points to scale a mesh by", "2.6.4", RefersTo::Point}},
    };
};
template <>
struct Layout<JointAngles> {
    static constexpr auto fields = std::tuple{Items<&JointAngles::joints>{
        {"joints", Unit::None, "22 joints, then up to 6 ergonomic angles", "2.7.1", RefersTo::Joint}}};
};
template <>
struct Layout<LinearKinematics> {
    static constexpr auto fields = std::tuple{Items<&LinearKinematics::segments>{
        {"segments", Unit::None, "body, props, left hand, right hand", "2.7.2", RefersTo::Segment}}};
};
template <>
struct Layout<AngularKinematics> {
    static constexpr auto fields = std::tuple{Items<&AngularKinematics::segments>{
        {"segments", Unit::None, "body, props, left hand, right hand", "2.7.3", RefersTo::Segment}}};
};
template <>
struct Layout<TrackerKinematics> {
    static constexpr auto fields = std::tuple{Items<&TrackerKinematics::trackers>{
        {"trackers", Unit::None, "segments with a tracker, 68 bytes each", "2.7.4", RefersTo::Tracker}}};
};
template <>
struct Layout<TrackerKinematics, Form::Short> {
    static constexpr auto isStandard = &TrackerKinematics::hasInertialData;
    static constexpr auto fields = std::tuple{Items<&TrackerKinematics::trackers, Form::Short>{
        {"trackers", Unit::None, "segments with a tracker, 44 bytes each", "N 2.7.4", RefersTo::Tracker}}};
};
template <>
struct Layout<CentreOfMass> {
    static constexpr auto fields = std::tuple{
        Field<&CentreOfMass::position>{{"position", Unit::Metres, "global, Z-up", "2.7.5"}},
        Field<&CentreOfMass::velocity>{{"velocity", Unit::MetresPerSecond, "global, Z-up", "real senders"}},
        Field<&CentreOfMass::acceleration>{
            {"acceleration", Unit::MetresPerSecondSquared, "global, Z-up", "real senders"}},
    };
};
static_assert(kWireSize<CentreOfMass> == 36);
template <>
struct Layout<CentreOfMass, Form::Short> {
    static constexpr auto isStandard = &CentreOfMass::hasDerivatives;
    static constexpr auto fields =
        std::tuple{Field<&CentreOfMass::position>{{"position", Unit::Metres, "global, Z-up", "2.7.5"}}};
};
static_assert(kWireSize<CentreOfMass, Form::Short> == 12);
template <>
struct Layout<TimeCode> {
    static constexpr auto fields = std::tuple{
        Field<&TimeCode::length>{{"length", Unit::ByteCount, "length of the string, 12", "2.5.12"}},
        Field<&TimeCode::text>{{"timeCode", Unit::TimeOfDay, "HH:MM:SS.mmm", "2.7.6"}},
    };
};
static_assert(kWireSize<TimeCode> == 16);
template <>
struct Layout<TimeCode, Form::Bare> {
    static constexpr auto isStandard = &TimeCode::hasLengthPrefix;
    static constexpr auto fields =
        std::tuple{Field<&TimeCode::text>{{"timeCode", Unit::TimeOfDay, "HH:MM:SS.mmm", "2.7.6"}}};
};
static_assert(kWireSize<TimeCode, Form::Bare> == 12);

} // namespace posewire::wire
