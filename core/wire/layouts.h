// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/field.h"
#include "core/wire/header.h"
#include "core/wire/messages.h"

/// How the items, the header and the messages are laid out on the wire. Sizes are held to the specification's
/// own totals.
namespace posewire::wire {

template <>
inline constexpr auto kLayout<SegmentEuler> = std::tuple{
    Field<&SegmentEuler::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9", RefersTo::Segment}},
    Field<&SegmentEuler::position>{
        {"position", Unit::Centimetres, "segment origin, global, Y-up right-handed", "2.5.6"}},
    Field<&SegmentEuler::rotation>{
        {"rotation", Unit::Degrees, "about fixed x, then y, then z: R = Rz·Ry·Rx", "2.5.7"}},
};
static_assert(kWireSize<SegmentEuler> == 28);

template <>
inline constexpr auto kLayout<SegmentQuaternion> = std::tuple{
    Field<&SegmentQuaternion::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9", RefersTo::Segment}},
    Field<&SegmentQuaternion::position>{
        {"position", Unit::Metres, "segment origin, global, Z-up right-handed", "2.5.6"}},
    Field<&SegmentQuaternion::orientation>{
        {"orientation", Unit::None, "world from segment, unit quaternion re i j k", "2.5.8"}},
};
static_assert(kWireSize<SegmentQuaternion> == 32);

template <>
inline constexpr auto kLayout<SegmentQuaternion, Form::Unity> = std::tuple{
    Field<&SegmentQuaternion::id>{
        {"id", Unit::Identifier, "segment in the Unity3D order, 1-based", "2.5.9", RefersTo::UnitySegment}},
    Field<&SegmentQuaternion::position>{
        {"position", Unit::Metres, "pelvis global, others relative; Y-up left-handed", "2.5.5"}},
    Field<&SegmentQuaternion::orientation>{
        {"orientation", Unit::None, "pelvis global, others from their parent; re i j k", "2.5.5"}},
};
static_assert(kWireSize<SegmentQuaternion, Form::Unity> == 32);

template <>
inline constexpr auto kLayout<Point> = std::tuple{
    Field<&Point::id>{{"id", Unit::Identifier, "256 × segment + point (100 × in older revisions), or a tag",
                       "2.5.10", RefersTo::Point}},
    Field<&Point::position>{{"position", Unit::Centimetres, "global, Y-up right-handed", "2.5.3"}},
};
static_assert(kWireSize<Point> == 16);

template <>
inline constexpr auto kLayout<SegmentScale> = std::tuple{
    Field<&SegmentScale::id>{{"id", Unit::Identifier, "segment, 1-based", "E 2.6", RefersTo::Segment}},
    Field<&SegmentScale::offset>{
        {"offset", Unit::None, "of the segment from its default position, Z-up", "E 2.6"}},
    Field<&SegmentScale::matrix>{
        {"matrix", Unit::None, "rotation and scale of the segment relative to the default", "E 2.6"}},
};
static_assert(kWireSize<SegmentScale> == 52);

template <>
inline constexpr auto kLayout<Prop> = std::tuple{
    Field<&Prop::id>{{"id", Unit::Identifier, "segment of the prop, 24 to 30", "E 2.6", RefersTo::Prop}},
    Text<&Prop::name, TextKind::ZeroTerminated>{{"name", Unit::None, "name of the prop", "E 2.6"}},
};
static_assert(kWireSize<Prop> == 5);

template <>
inline constexpr auto kLayout<NullPoseSegment> = std::tuple{
    Text<&NullPoseSegment::name, TextKind::Prefixed>{{"name", Unit::None, "name of the segment", "2.6.4"}},
    Field<&NullPoseSegment::position>{
        {"position", Unit::Metres, "segment origin in the T-pose, Z-up", "2.6.4"}},
};
static_assert(kWireSize<NullPoseSegment> == 16);

template <>
inline constexpr auto kLayout<NullPosePoint> = std::tuple{
    Field<&NullPosePoint::segment>{
        {"segment", Unit::Identifier, "segment that carries the point", "2.6.4", RefersTo::Carrier}},
    Field<&NullPosePoint::point>{
        {"point", Unit::Identifier, "point within the segment", "2.6.4", RefersTo::LocalPoint}},
    Text<&NullPosePoint::name, TextKind::Prefixed>{{"name", Unit::None, "name of the point", "2.6.4"}},
    Field<&NullPosePoint::flags>{
        {"flags", Unit::Flags, "characteristics; their meaning is not published", "2.6.4"}},
    Field<&NullPosePoint::position>{
        {"position", Unit::Metres, "relative to the segment origin, Z-up", "2.6.4"}},
};
static_assert(kWireSize<NullPosePoint> == 24);

template <>
inline constexpr auto kLayout<Joint> = std::tuple{
    Field<&Joint::parent>{{"parent", Unit::Identifier, "point of the parent segment: 256 × segment + point",
                           "2.7.1", RefersTo::JointEnd}},
    Field<&Joint::child>{{"child", Unit::Identifier, "point of the child segment: 256 × segment + point",
                          "2.7.1", RefersTo::JointEnd}},
    Field<&Joint::rotation>{
        {"rotation", Unit::Degrees, "x abduction, y axial rotation, z flexion (ISB axes)", "2.7.1"}},
};
static_assert(kWireSize<Joint> == 20);

template <>
inline constexpr auto kLayout<LinearSegment> = std::tuple{
    Field<&LinearSegment::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9", RefersTo::Segment}},
    Field<&LinearSegment::position>{{"position", Unit::Metres, "segment origin, global, Z-up", "2.7.2"}},
    Field<&LinearSegment::velocity>{{"velocity", Unit::MetresPerSecond, "global, Z-up", "2.7.2"}},
    Field<&LinearSegment::acceleration>{
        {"acceleration", Unit::MetresPerSecondSquared, "global, Z-up", "2.7.2"}},
};
static_assert(kWireSize<LinearSegment> == 40);

template <>
inline constexpr auto kLayout<AngularSegment> = std::tuple{
    Field<&AngularSegment::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9", RefersTo::Segment}},
    Field<&AngularSegment::orientation>{{"orientation", Unit::None, "world from segment, re i j k", "2.7.3"}},
    Field<&AngularSegment::angularVelocity>{
        {"angularVelocity", Unit::RadiansPerSecond, "global, Z-up", "2.7.3"}},
    Field<&AngularSegment::angularAcceleration>{
        {"angularAcceleration", Unit::RadiansPerSecondSquared, "global, Z-up", "2.7.3"}},
};
static_assert(kWireSize<AngularSegment> == 44);

template <>
inline constexpr auto kLayout<Tracker> = std::tuple{
    Field<&Tracker::id>{
        {"id", Unit::Identifier, "segment that carries the tracker", "2.7.4", RefersTo::Tracker}},
    Field<&Tracker::orientation>{{"orientation", Unit::None, "world from tracker, re i j k", "2.7.4"}},
    Field<&Tracker::freeAcceleration>{
        {"freeAcceleration", Unit::MetresPerSecondSquared, "global, without gravity", "2.7.4"}},
    Field<&Tracker::acceleration>{
        {"acceleration", Unit::MetresPerSecondSquared, "tracker-local, specific force", "2.7.4"}},
    Field<&Tracker::angularVelocity>{{"angularVelocity", Unit::RadiansPerSecond, "tracker-local", "2.7.4"}},
    Field<&Tracker::magneticField>{
        {"magneticField", Unit::ArbitraryUnits, "tracker-local, about 1 undisturbed", "2.7.4"}},
};
static_assert(kWireSize<Tracker> == 68);

template <>
inline constexpr auto kLayout<Tracker, Form::Short> = std::tuple{
    Field<&Tracker::id>{
        {"id", Unit::Identifier, "segment that carries the tracker", "N 2.7.4", RefersTo::Tracker}},
    Field<&Tracker::orientation>{{"orientation", Unit::None, "world from tracker, re i j k", "N 2.7.4"}},
    Field<&Tracker::freeAcceleration>{
        {"freeAcceleration", Unit::MetresPerSecondSquared, "global, without gravity", "N 2.7.4"}},
    Field<&Tracker::magneticField>{
        {"magneticField", Unit::ArbitraryUnits, "tracker-local, about 1 undisturbed", "N 2.7.4"}},
};
static_assert(kWireSize<Tracker, Form::Short> == 44);

inline constexpr std::array<FieldPart, 2> kIdParts{{
    {"magic", "", Unit::None, "every datagram begins with MXTP", 0, 4},
    {"type", "type", Unit::Identifier, "message type", 4, 2},
}};
inline constexpr std::array<FieldPart, 2> kCounterParts{{
    {"index", "datagram", Unit::Count, "place among the datagrams of the sample, bits 0 to 6", 0, 1, 0x7f},
    {"last", "last", Unit::None, "the last datagram of its sample, bit 7", 0, 1, 0x80},
}};

template <>
inline constexpr auto kLayout<Header> = std::tuple{
    Field<&Header::id>{{"id", Unit::None, "\"MXTP\" and the message type as two digits", "2.4.1.1",
                        RefersTo::Nothing, kIdParts}},
    Field<&Header::sampleCounter>{
        {"sample", Unit::Count, "counts sampled frames; shared by all types of a frame", "2.4.1.2"}},
    Field<&Header::datagramCounter>{{"datagramCounter", Unit::None,
                                     "index of the datagram in its sample; bit 7 marks the last", "2.4.1.3",
                                     RefersTo::Nothing, kCounterParts}},
    Field<&Header::items>{{"items", Unit::Count, "segments or points in this datagram", "2.4.1.4"}},
    Field<&Header::timeCode>{{"timeCode", Unit::Milliseconds,
                              "clock of the sender: since the start of a recording, or time of day when live",
                              "2.4.1.5"}},
    Field<&Header::character>{{"character", Unit::Identifier, "which character the data belong to, from 0",
                               "2.4.1.6", RefersTo::Character}},
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
static_assert(kWireSize<Header> == kHeaderSize);

template <>
inline constexpr auto kLayout<PoseEuler> = std::tuple{
    Items<&PoseEuler::segments>{{"segments", Unit::None, "body, then props", "2.5.1", RefersTo::Segment}}};
template <>
inline constexpr auto kLayout<PoseQuaternion> = std::tuple{Items<&PoseQuaternion::segments>{
    {"segments", Unit::None, "body, props, left hand, right hand", "2.5.2", RefersTo::Segment}}};
template <>
inline constexpr auto kLayout<PointPositions> = std::tuple{
    Items<&PointPositions::points>{{"points", Unit::None, "markers, then tags", "2.5.3", RefersTo::Point}}};
template <>
inline constexpr auto kLayout<TagPositions> = std::tuple{Items<&TagPositions::points>{
    {"points", Unit::None, "tags that no character has", "E 2.5", RefersTo::Tag}}};
template <>
inline constexpr auto kLayout<PoseUnity> = std::tuple{Items<&PoseUnity::segments, Form::Unity>{
    {"segments", Unit::None, "23 segments in the Unity3D order", "2.5.5", RefersTo::UnitySegment}}};
template <>
inline constexpr auto kLayout<ScaleInformation> = std::tuple{Items<&ScaleInformation::segments>{
    {"segments", Unit::None, "scale of each segment of the mesh", "E 2.6", RefersTo::Segment}}};
template <>
inline constexpr auto kLayout<PropInformation> = std::tuple{Items<&PropInformation::props>{
    {"props", Unit::None, "the props in use; none when empty", "E 2.6", RefersTo::Prop}}};
template <>
inline constexpr auto kLayout<MetaData> = std::tuple{
    Text<&MetaData::text, TextKind::Prefixed>{{"text", Unit::TagLines, "one \"tag:value\" a line", "2.6.3"}}};
template <>
inline constexpr auto kIsStandard<MetaData> = &MetaData::hasLengthPrefix;
template <>
inline constexpr auto kLayout<MetaData, Form::Bare> = std::tuple{
    Text<&MetaData::text, TextKind::ToEnd>{{"text", Unit::TagLines, "one \"tag:value\" a line", "E 2.6"}}};
template <>
inline constexpr auto kLayout<NullPose> = std::tuple{
    CountedList<&NullPose::segments, kMaxNullPoseSegments>{
        {"segments", Unit::None, "null pose: a T-pose with all orientations identity", "2.6.4",
         RefersTo::Segment}},
    CountedList<&NullPose::points, kMaxNullPosePoints>{
        {"points", Unit::None, "points to scale a mesh by", "2.6.4", RefersTo::Point}},
};
template <>
inline constexpr auto kLayout<JointAngles> = std::tuple{Items<&JointAngles::joints>{
    {"joints", Unit::None, "22 joints, then up to 6 ergonomic angles", "2.7.1", RefersTo::Joint}}};
template <>
inline constexpr auto kLayout<LinearKinematics> = std::tuple{Items<&LinearKinematics::segments>{
    {"segments", Unit::None, "body, props, left hand, right hand", "2.7.2", RefersTo::Segment}}};
template <>
inline constexpr auto kLayout<AngularKinematics> = std::tuple{Items<&AngularKinematics::segments>{
    {"segments", Unit::None, "body, props, left hand, right hand", "2.7.3", RefersTo::Segment}}};
template <>
inline constexpr auto kLayout<TrackerKinematics> = std::tuple{Items<&TrackerKinematics::trackers>{
    {"trackers", Unit::None, "segments with a tracker, 68 bytes each", "2.7.4", RefersTo::Tracker}}};
template <>
inline constexpr auto kIsStandard<TrackerKinematics> = &TrackerKinematics::hasInertialData;
template <>
inline constexpr auto kLayout<TrackerKinematics, Form::Short> =
    std::tuple{Items<&TrackerKinematics::trackers, Form::Short>{
        {"trackers", Unit::None, "segments with a tracker, 44 bytes each", "N 2.7.4", RefersTo::Tracker}}};
template <>
inline constexpr auto kLayout<CentreOfMass> = std::tuple{
    Field<&CentreOfMass::position>{{"position", Unit::Metres, "global, Z-up", "2.7.5"}},
    Field<&CentreOfMass::velocity>{{"velocity", Unit::MetresPerSecond, "global, Z-up", "real senders"}},
    Field<&CentreOfMass::acceleration>{
        {"acceleration", Unit::MetresPerSecondSquared, "global, Z-up", "real senders"}},
};
static_assert(kWireSize<CentreOfMass> == 36);
template <>
inline constexpr auto kIsStandard<CentreOfMass> = &CentreOfMass::hasDerivatives;
template <>
inline constexpr auto kLayout<CentreOfMass, Form::Short> =
    std::tuple{Field<&CentreOfMass::position>{{"position", Unit::Metres, "global, Z-up", "2.7.5"}}};
static_assert(kWireSize<CentreOfMass, Form::Short> == 12);
template <>
inline constexpr auto kLayout<TimeCode> = std::tuple{
    Field<&TimeCode::length>{{"length", Unit::ByteCount, "length of the string, 12", "2.5.12"}},
    Field<&TimeCode::text>{{"timeCode", Unit::TimeOfDay, "HH:MM:SS.mmm", "2.7.6"}},
};
static_assert(kWireSize<TimeCode> == 16);
template <>
inline constexpr auto kIsStandard<TimeCode> = &TimeCode::hasLengthPrefix;
template <>
inline constexpr auto kLayout<TimeCode, Form::Bare> =
    std::tuple{Field<&TimeCode::text>{{"timeCode", Unit::TimeOfDay, "HH:MM:SS.mmm", "2.7.6"}}};
static_assert(kWireSize<TimeCode, Form::Bare> == 12);

} // namespace posewire::wire
