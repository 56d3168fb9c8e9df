// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/types.h"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// A type for each message and for the items in their lists, as plain values; core/wire/layouts.h
/// has their layouts.
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

/// A message that is a list of items, each about a segment.
template <std::uint8_t Type, class Item>
struct SegmentMessage {
    static constexpr std::uint8_t kType = Type;
    std::vector<Item> segments;
    friend bool operator==(const SegmentMessage&, const SegmentMessage&) = default;
};
using PoseEuler = SegmentMessage<1, SegmentEuler>;
using PoseQuaternion = SegmentMessage<2, SegmentQuaternion>;
using PoseUnity = SegmentMessage<5, SegmentQuaternion>;
using ScaleInformation = SegmentMessage<10, SegmentScale>;
using LinearKinematics = SegmentMessage<21, LinearSegment>;
using AngularKinematics = SegmentMessage<22, AngularSegment>;

template <std::uint8_t Type>
struct PointMessage {
    static constexpr std::uint8_t kType = Type;
    std::vector<Point> points;
    friend bool operator==(const PointMessage&, const PointMessage&) = default;
};
using PointPositions = PointMessage<3>;
using TagPositions = PointMessage<4>;

struct PropInformation {
    static constexpr std::uint8_t kType = 11;
    std::vector<Prop> props;
    friend bool operator==(const PropInformation&, const PropInformation&) = default;
};

/// The text is kept as sent; core/wire/text.h splits it into tags.
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
    /// Of the day; of no use if it is not HH:MM:SS.mmm.
    [[nodiscard]] std::int32_t milliseconds() const {
        const auto at = [this](std::size_t place) { return text[place] - '0'; };
        const auto two = [&](std::size_t place) { return 10 * at(place) + at(place + 1); };
        return ((two(0) * 60 + two(3)) * 60 + two(6)) * 1000 + 10 * two(9) + at(11);
    }
    friend bool operator==(const TimeCode&, const TimeCode&) = default;
};

/// The payload of a type that is not known, or of a type 04 in the undocumented newer layout.
struct RawBody {
    std::vector<std::byte> bytes;
    friend bool operator==(const RawBody&, const RawBody&) = default;
};

// A build may know further types: `, Type …` with structs declared before this header. tests/extension does.
#ifndef POSEWIRE_FURTHER_MESSAGES
#define POSEWIRE_FURTHER_MESSAGES
#endif

/// The list of all message types; whatever concerns each of them goes through it.
template <class... Message>
struct MessageList {
    using Body = std::variant<RawBody, Message...>;

    /// Calls f.template operator()<Message>() for each, in order.
    template <class Function>
    static constexpr void forEach(Function&& f) {
        (f.template operator()<Message>(), ...);
    }
    /// Calls f.template operator()<Message>() for the message of that type; false if it is not known.
    template <class Function>
    static constexpr bool with(std::uint8_t type, Function&& f) {
        return ((Message::kType == type && (f.template operator()<Message>(), true)) || ...);
    }
};
using Messages =
    MessageList<PoseEuler, PoseQuaternion, PointPositions, TagPositions, PoseUnity, ScaleInformation,
                PropInformation, MetaData, NullPose, JointAngles, LinearKinematics, AngularKinematics,
                TrackerKinematics, CentreOfMass, TimeCode POSEWIRE_FURTHER_MESSAGES>;
using Body = Messages::Body;

/// The most items that the lists of a scale message may have; real ones have up to 67 and about 127.
inline constexpr std::size_t kMaxNullPoseSegments = 255;
inline constexpr std::size_t kMaxNullPosePoints = 4096;

} // namespace posewire::wire
