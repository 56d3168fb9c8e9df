// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/items.h"

#include <variant>

/// One struct for each message type, with its layout. To add a type: a struct and its layout here, and one
/// row in type_table.cpp.
namespace posewire::wire {

struct PoseEuler {
    static constexpr std::uint8_t kType = 1;
    std::vector<SegmentEuler> segments;
    friend bool operator==(const PoseEuler&, const PoseEuler&) = default;
};

struct PoseQuaternion {
    static constexpr std::uint8_t kType = 2;
    std::vector<SegmentQuaternion> segments;
    friend bool operator==(const PoseQuaternion&, const PoseQuaternion&) = default;
};

struct PointPositions {
    static constexpr std::uint8_t kType = 3;
    std::vector<Point> points;
    friend bool operator==(const PointPositions&, const PointPositions&) = default;
};

struct TagPositions {
    static constexpr std::uint8_t kType = 4;
    std::vector<Point> points;
    friend bool operator==(const TagPositions&, const TagPositions&) = default;
};

struct PoseUnity {
    static constexpr std::uint8_t kType = 5;
    std::vector<SegmentQuaternion> segments;
    friend bool operator==(const PoseUnity&, const PoseUnity&) = default;
};

struct ScaleInformation {
    static constexpr std::uint8_t kType = 10;
    std::vector<SegmentScale> segments;
    friend bool operator==(const ScaleInformation&, const ScaleInformation&) = default;
};

struct PropInformation {
    static constexpr std::uint8_t kType = 11;
    std::vector<Prop> props;
    friend bool operator==(const PropInformation&, const PropInformation&) = default;
};

/// The text is kept as sent; core/wire/metadata_text.h splits it into tags.
struct MetaData {
    static constexpr std::uint8_t kType = 12;
    bool hasLengthPrefix = true;
    std::string text;
    friend bool operator==(const MetaData&, const MetaData&) = default;
};

/// One part of a scale message; the first datagram has the segments, the following ones the points.
struct NullPose {
    static constexpr std::uint8_t kType = 13;
    std::vector<NullPoseSegment> segments;
    std::vector<NullPosePoint> points;
    friend bool operator==(const NullPose&, const NullPose&) = default;
};

struct JointAngles {
    static constexpr std::uint8_t kType = 20;
    std::vector<Joint> joints;
    friend bool operator==(const JointAngles&, const JointAngles&) = default;
};

struct LinearKinematics {
    static constexpr std::uint8_t kType = 21;
    std::vector<LinearSegment> segments;
    friend bool operator==(const LinearKinematics&, const LinearKinematics&) = default;
};

struct AngularKinematics {
    static constexpr std::uint8_t kType = 22;
    std::vector<AngularSegment> segments;
    friend bool operator==(const AngularKinematics&, const AngularKinematics&) = default;
};

struct TrackerKinematics {
    static constexpr std::uint8_t kType = 23;
    /// False in the 44-byte form, which has no local acceleration and no angular velocity.
    bool hasInertialData = true;
    std::vector<Tracker> trackers;
    friend bool operator==(const TrackerKinematics&, const TrackerKinematics&) = default;
};

struct CentreOfMass {
    static constexpr std::uint8_t kType = 24;
    /// False in the 12-byte form, which has the position alone.
    bool hasDerivatives = true;
    Vec3 position{};
    Vec3 velocity{};
    Vec3 acceleration{};
    friend bool operator==(const CentreOfMass&, const CentreOfMass&) = default;
};

struct TimeCode {
    static constexpr std::uint8_t kType = 25;
    bool hasLengthPrefix = true;
    std::int32_t length = 12; ///< as sent; should be 12
    std::array<char, 12> text{'0', '0', ':', '0', '0', ':', '0', '0', '.', '0', '0', '0'};
    [[nodiscard]] std::string_view view() const { return {text.data(), text.size()}; }
    friend bool operator==(const TimeCode&, const TimeCode&) = default;
};

/// The payload of a type that is not known, or of a type 04 in the undocumented newer layout.
struct RawBody {
    std::vector<std::byte> bytes;
    friend bool operator==(const RawBody&, const RawBody&) = default;
};

using Body = std::variant<RawBody, PoseEuler, PoseQuaternion, PointPositions, TagPositions, PoseUnity,
                          ScaleInformation, PropInformation, MetaData, NullPose, JointAngles,
                          LinearKinematics, AngularKinematics, TrackerKinematics, CentreOfMass, TimeCode>;

/// The most items that the lists of a scale message may have; real ones have up to 67 and about 127.
inline constexpr std::size_t kMaxNullPoseSegments = 255;
inline constexpr std::size_t kMaxNullPosePoints = 4096;

template <>
struct Layout<PoseEuler> {
    static constexpr auto fields =
        std::tuple{Items<&PoseEuler::segments>{{"segments", Unit::None, "body, then props", "2.5.1"}}};
};
template <>
struct Layout<PoseQuaternion> {
    static constexpr auto fields = std::tuple{Items<&PoseQuaternion::segments>{
        {"segments", Unit::None, "body, props, left hand, right hand", "2.5.2"}}};
};
template <>
struct Layout<PointPositions> {
    static constexpr auto fields =
        std::tuple{Items<&PointPositions::points>{{"points", Unit::None, "markers, then tags", "2.5.3"}}};
};
template <>
struct Layout<TagPositions> {
    static constexpr auto fields = std::tuple{
        Items<&TagPositions::points>{{"points", Unit::None, "tags that no character has", "E 2.5"}}};
};
template <>
struct Layout<PoseUnity> {
    static constexpr auto fields = std::tuple{Items<&PoseUnity::segments, Form::Unity>{
        {"segments", Unit::None, "23 segments in the Unity3D order", "2.5.5"}}};
};
template <>
struct Layout<ScaleInformation> {
    static constexpr auto fields = std::tuple{Items<&ScaleInformation::segments>{
        {"segments", Unit::None, "scale of each segment of the mesh", "E 2.6"}}};
};
template <>
struct Layout<PropInformation> {
    static constexpr auto fields = std::tuple{
        Items<&PropInformation::props>{{"props", Unit::None, "the props in use; none when empty", "E 2.6"}}};
};
template <>
struct Layout<MetaData> {
    static constexpr auto fields = std::tuple{
        Text<&MetaData::text, TextKind::Prefixed>{{"text", Unit::None, "one \"tag:value\" a line", "2.6.3"}}};
};
template <>
struct Layout<MetaData, Form::Bare> {
    static constexpr auto fields = std::tuple{
        Text<&MetaData::text, TextKind::ToEnd>{{"text", Unit::None, "one \"tag:value\" a line", "E 2.6"}}};
};
template <>
struct Layout<NullPose> {
    static constexpr auto fields = std::tuple{
        CountedList<&NullPose::segments, kMaxNullPoseSegments>{
            {"segments", Unit::None, "null pose: a T-pose with all orientations identity", "2.6.4"}},
        CountedList<&NullPose::points, kMaxNullPosePoints>{
            {"points", Unit::None, "points to scale a mesh by", "2.6.4"}},
    };
};
template <>
struct Layout<JointAngles> {
    static constexpr auto fields = std::tuple{Items<&JointAngles::joints>{
        {"joints", Unit::None, "22 joints, then up to 6 ergonomic angles", "2.7.1"}}};
};
template <>
struct Layout<LinearKinematics> {
    static constexpr auto fields = std::tuple{Items<&LinearKinematics::segments>{
        {"segments", Unit::None, "body, props, left hand, right hand", "2.7.2"}}};
};
template <>
struct Layout<AngularKinematics> {
    static constexpr auto fields = std::tuple{Items<&AngularKinematics::segments>{
        {"segments", Unit::None, "body, props, left hand, right hand", "2.7.3"}}};
};
template <>
struct Layout<TrackerKinematics> {
    static constexpr auto fields = std::tuple{Items<&TrackerKinematics::trackers>{
        {"trackers", Unit::None, "segments with a tracker, 68 bytes each", "2.7.4"}}};
};
template <>
struct Layout<TrackerKinematics, Form::Short> {
    static constexpr auto fields = std::tuple{Items<&TrackerKinematics::trackers, Form::Short>{
        {"trackers", Unit::None, "segments with a tracker, 44 bytes each", "N 2.7.4"}}};
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
    static constexpr auto fields =
        std::tuple{Field<&CentreOfMass::position>{{"position", Unit::Metres, "global, Z-up", "2.7.5"}}};
};
static_assert(kWireSize<CentreOfMass, Form::Short> == 12);
template <>
struct Layout<TimeCode> {
    static constexpr auto fields = std::tuple{
        Field<&TimeCode::length>{{"length", Unit::ByteCount, "length of the string, 12", "2.5.12"}},
        Field<&TimeCode::text>{{"timeCode", Unit::None, "HH:MM:SS.mmm", "2.7.6"}},
    };
};
static_assert(kWireSize<TimeCode> == 16);
template <>
struct Layout<TimeCode, Form::Bare> {
    static constexpr auto fields =
        std::tuple{Field<&TimeCode::text>{{"timeCode", Unit::None, "HH:MM:SS.mmm", "2.7.6"}}};
};
static_assert(kWireSize<TimeCode, Form::Bare> == 12);

} // namespace posewire::wire
