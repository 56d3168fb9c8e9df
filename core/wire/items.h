// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/types.h"

#include <string>

/// The repeated records of the messages, as plain values; core/wire/item_layouts.h has their layouts.
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

} // namespace posewire::wire
