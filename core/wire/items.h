// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/field.h"

/// The repeated records of the messages and their layouts. Sizes are held to the specification's own totals.
namespace posewire::wire {

struct SegmentEuler {
    std::uint32_t id = 0;
    Vec3 position{};
    Vec3 rotation{};
    friend bool operator==(const SegmentEuler&, const SegmentEuler&) = default;
};

struct SegmentQuaternion {
    std::uint32_t id = 0;
    Vec3 position{};
    Quat orientation{1, 0, 0, 0};
    friend bool operator==(const SegmentQuaternion&, const SegmentQuaternion&) = default;
};

struct Point {
    std::uint32_t id = 0;
    Vec3 position{};
    friend bool operator==(const Point&, const Point&) = default;
};

struct SegmentScale {
    std::uint32_t id = 0;
    Vec3 offset{};
    Mat3 matrix{};
    friend bool operator==(const SegmentScale&, const SegmentScale&) = default;
};

struct Prop {
    std::uint32_t id = 0;
    std::string name;
    friend bool operator==(const Prop&, const Prop&) = default;
};

struct NullPoseSegment {
    std::string name;
    Vec3 position{};
    friend bool operator==(const NullPoseSegment&, const NullPoseSegment&) = default;
};

struct NullPosePoint {
    std::uint16_t segment = 0;
    std::uint16_t point = 0;
    std::string name;
    std::uint32_t flags = 0;
    Vec3 position{};
    friend bool operator==(const NullPosePoint&, const NullPosePoint&) = default;
};

struct Joint {
    std::uint32_t parent = 0;
    std::uint32_t child = 0;
    Vec3 rotation{};
    friend bool operator==(const Joint&, const Joint&) = default;
};

struct LinearSegment {
    std::uint32_t id = 0;
    Vec3 position{};
    Vec3 velocity{};
    Vec3 acceleration{};
    friend bool operator==(const LinearSegment&, const LinearSegment&) = default;
};

struct AngularSegment {
    std::uint32_t id = 0;
    Quat orientation{1, 0, 0, 0};
    Vec3 angularVelocity{};
    Vec3 angularAcceleration{};
    friend bool operator==(const AngularSegment&, const AngularSegment&) = default;
};

/// In the 44-byte form acceleration and angularVelocity are not on the wire and stay zero.
struct Tracker {
    std::uint32_t id = 0;
    Quat orientation{1, 0, 0, 0};
    Vec3 freeAcceleration{};
    Vec3 acceleration{};
    Vec3 angularVelocity{};
    Vec3 magneticField{};
    friend bool operator==(const Tracker&, const Tracker&) = default;
};

template <>
struct Layout<SegmentEuler> {
    static constexpr auto fields = std::tuple{
        Field<&SegmentEuler::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9"}},
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
        Field<&SegmentQuaternion::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9"}},
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
        Field<&SegmentQuaternion::id>{
            {"id", Unit::Identifier, "segment in the Unity3D order, 1-based", "2.5.9"}},
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
        Field<&Point::id>{
            {"id", Unit::Identifier, "256 × segment + point (100 × in older revisions), or a tag", "2.5.10"}},
        Field<&Point::position>{{"position", Unit::Centimetres, "global, Y-up right-handed", "2.5.3"}},
    };
};
static_assert(kWireSize<Point> == 16);

template <>
struct Layout<SegmentScale> {
    static constexpr auto fields = std::tuple{
        Field<&SegmentScale::id>{{"id", Unit::Identifier, "segment, 1-based", "E 2.6"}},
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
        Field<&Prop::id>{{"id", Unit::Identifier, "segment of the prop, 24 to 30", "E 2.6"}},
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
            {"segment", Unit::Identifier, "segment that carries the point", "2.6.4"}},
        Field<&NullPosePoint::point>{{"point", Unit::Identifier, "point within the segment", "2.6.4"}},
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
        Field<&Joint::parent>{
            {"parent", Unit::Identifier, "point of the parent segment: 256 × segment + point", "2.7.1"}},
        Field<&Joint::child>{
            {"child", Unit::Identifier, "point of the child segment: 256 × segment + point", "2.7.1"}},
        Field<&Joint::rotation>{
            {"rotation", Unit::Degrees, "x abduction, y axial rotation, z flexion (ISB axes)", "2.7.1"}},
    };
};
static_assert(kWireSize<Joint> == 20);

template <>
struct Layout<LinearSegment> {
    static constexpr auto fields = std::tuple{
        Field<&LinearSegment::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9"}},
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
        Field<&AngularSegment::id>{{"id", Unit::Identifier, "segment, 1-based", "2.5.9"}},
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
        Field<&Tracker::id>{{"id", Unit::Identifier, "segment that carries the tracker", "2.7.4"}},
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
        Field<&Tracker::id>{{"id", Unit::Identifier, "segment that carries the tracker", "N 2.7.4"}},
        Field<&Tracker::orientation>{{"orientation", Unit::None, "world from tracker, re i j k", "N 2.7.4"}},
        Field<&Tracker::freeAcceleration>{
            {"freeAcceleration", Unit::MetresPerSecondSquared, "global, without gravity", "N 2.7.4"}},
        Field<&Tracker::magneticField>{
            {"magneticField", Unit::ArbitraryUnits, "tracker-local, about 1 undisturbed", "N 2.7.4"}},
    };
};
static_assert(kWireSize<Tracker, Form::Short> == 44);

} // namespace posewire::wire
