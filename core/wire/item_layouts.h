// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/field.h"
#include "core/wire/items.h"

/// How the items stand on the wire. Sizes are held to the specification's own totals.
namespace posewire::wire {

template <>
struct Layout<SegmentEuler> {
    static constexpr auto fields = std::tuple{
        Field<&SegmentEuler::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9", RefersTo::Segment}},
        Field<&SegmentEuler::position>{
            {"position", Unit::Centimetres, "segment origin, global, Y-up right-handed", "2.5.6"}},
        Field<&SegmentEuler::rotation>{
            {"rotation", Unit::Degrees, "about fixed x, then y, then z: R = Rz·Ry·Rx", "2.5.7"}},
    };
};
static_assert(kWireSize<SegmentEuler> == 28);

template <>
struct Layout<SegmentQuaternion> {
    static constexpr auto fields = std::tuple{
        Field<&SegmentQuaternion::id>{
            {"id", Unit::Identifier, "segment, 1-based", "2.5.9", RefersTo::Segment}},
        Field<&SegmentQuaternion::position>{
            {"position", Unit::Metres, "segment origin, global, Z-up right-handed", "2.5.6"}},
        Field<&SegmentQuaternion::orientation>{
            {"orientation", Unit::None, "world from segment, unit quaternion re i j k", "2.5.8"}},
    };
};
static_assert(kWireSize<SegmentQuaternion> == 32);

template <>
struct Layout<SegmentQuaternion, Form::Unity> {
    static constexpr auto fields = std::tuple{
        Field<&SegmentQuaternion::id>{{"id", Unit::Identifier, "segment in the Unity3D order, 1-based",
                                       "2.5.9", RefersTo::UnitySegment}},
        Field<&SegmentQuaternion::position>{
            {"position", Unit::Metres, "pelvis global, others relative; Y-up left-handed", "2.5.5"}},
        Field<&SegmentQuaternion::orientation>{
            {"orientation", Unit::None, "pelvis global, others from their parent; re i j k", "2.5.5"}},
    };
};
static_assert(kWireSize<SegmentQuaternion, Form::Unity> == 32);

template <>
struct Layout<Point> {
    static constexpr auto fields = std::tuple{
        Field<&Point::id>{{"id", Unit::Identifier,
                           "256 × segment + point (100 × in older revisions), or a tag", "2.5.10",
                           RefersTo::Point}},
        Field<&Point::position>{{"position", Unit::Centimetres, "global, Y-up right-handed", "2.5.3"}},
    };
};
static_assert(kWireSize<Point> == 16);

template <>
struct Layout<SegmentScale> {
    static constexpr auto fields = std::tuple{
        Field<&SegmentScale::id>{{"id", Unit::Identifier, "segment, 1-based", "E 2.6", RefersTo::Segment}},
        Field<&SegmentScale::offset>{
            {"offset", Unit::None, "of the segment from its default position, Z-up", "E 2.6"}},
        Field<&SegmentScale::matrix>{
            {"matrix", Unit::None, "rotation and scale of the segment relative to the default", "E 2.6"}},
    };
};
static_assert(kWireSize<SegmentScale> == 52);

template <>
struct Layout<Prop> {
    static constexpr auto fields = std::tuple{
        Field<&Prop::id>{{"id", Unit::Identifier, "segment of the prop, 24 to 30", "E 2.6", RefersTo::Prop}},
        Text<&Prop::name, TextKind::ZeroTerminated>{{"name", Unit::None, "name of the prop", "E 2.6"}},
    };
};
static_assert(kWireSize<Prop> == 5);

template <>
struct Layout<NullPoseSegment> {
    static constexpr auto fields = std::tuple{
        Text<&NullPoseSegment::name, TextKind::Prefixed>{
            {"name", Unit::None, "name of the segment", "2.6.4"}},
        Field<&NullPoseSegment::position>{
            {"position", Unit::Metres, "segment origin in the T-pose, Z-up", "2.6.4"}},
    };
};
static_assert(kWireSize<NullPoseSegment> == 16);

template <>
struct Layout<NullPosePoint> {
    static constexpr auto fields = std::tuple{
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
};
static_assert(kWireSize<NullPosePoint> == 24);

template <>
struct Layout<Joint> {
    static constexpr auto fields = std::tuple{
        Field<&Joint::parent>{{"parent", Unit::Identifier,
                               "point of the parent segment: 256 × segment + point", "2.7.1",
                               RefersTo::JointEnd}},
        Field<&Joint::child>{{"child", Unit::Identifier, "point of the child segment: 256 × segment + point",
                              "2.7.1", RefersTo::JointEnd}},
        Field<&Joint::rotation>{
            {"rotation", Unit::Degrees, "x abduction, y axial rotation, z flexion (ISB axes)", "2.7.1"}},
    };
};
static_assert(kWireSize<Joint> == 20);

template <>
struct Layout<LinearSegment> {
    static constexpr auto fields = std::tuple{
        Field<&LinearSegment::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9", RefersTo::Segment}},
        Field<&LinearSegment::position>{{"position", Unit::Metres, "segment origin, global, Z-up", "2.7.2"}},
        Field<&LinearSegment::velocity>{{"velocity", Unit::MetresPerSecond, "global, Z-up", "2.7.2"}},
        Field<&LinearSegment::acceleration>{
            {"acceleration", Unit::MetresPerSecondSquared, "global, Z-up", "2.7.2"}},
    };
};
static_assert(kWireSize<LinearSegment> == 40);

template <>
struct Layout<AngularSegment> {
    static constexpr auto fields = std::tuple{
        Field<&AngularSegment::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9", RefersTo::Segment}},
        Field<&AngularSegment::orientation>{
            {"orientation", Unit::None, "world from segment, re i j k", "2.7.3"}},
        Field<&AngularSegment::angularVelocity>{
            {"angularVelocity", Unit::RadiansPerSecond, "global, Z-up", "2.7.3"}},
        Field<&AngularSegment::angularAcceleration>{
            {"angularAcceleration", Unit::RadiansPerSecondSquared, "global, Z-up", "2.7.3"}},
    };
};
static_assert(kWireSize<AngularSegment> == 44);

template <>
struct Layout<Tracker> {
    static constexpr auto fields = std::tuple{
        Field<&Tracker::id>{
            {"id", Unit::Identifier, "segment that carries the tracker", "2.7.4", RefersTo::Tracker}},
        Field<&Tracker::orientation>{{"orientation", Unit::None, "world from tracker, re i j k", "2.7.4"}},
        Field<&Tracker::freeAcceleration>{
            {"freeAcceleration", Unit::MetresPerSecondSquared, "global, without gravity", "2.7.4"}},
        Field<&Tracker::acceleration>{
            {"acceleration", Unit::MetresPerSecondSquared, "tracker-local, specific force", "2.7.4"}},
        Field<&Tracker::angularVelocity>{
            {"angularVelocity", Unit::RadiansPerSecond, "tracker-local", "2.7.4"}},
        Field<&Tracker::magneticField>{
            {"magneticField", Unit::ArbitraryUnits, "tracker-local, about 1 undisturbed", "2.7.4"}},
    };
};
static_assert(kWireSize<Tracker> == 68);

template <>
struct Layout<Tracker, Form::Short> {
    static constexpr auto fields = std::tuple{
        Field<&Tracker::id>{
            {"id", Unit::Identifier, "segment that carries the tracker", "N 2.7.4", RefersTo::Tracker}},
        Field<&Tracker::orientation>{{"orientation", Unit::None, "world from tracker, re i j k", "N 2.7.4"}},
        Field<&Tracker::freeAcceleration>{
            {"freeAcceleration", Unit::MetresPerSecondSquared, "global, without gravity", "N 2.7.4"}},
        Field<&Tracker::magneticField>{
            {"magneticField", Unit::ArbitraryUnits, "tracker-local, about 1 undisturbed", "N 2.7.4"}},
    };
};
static_assert(kWireSize<Tracker, Form::Short> == 44);

} // namespace posewire::wire
