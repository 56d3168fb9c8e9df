// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <glm/vec3.hpp>

namespace posewire::render {

/// The 23 body segments of MVN in the order of their IDs: index = ID − 1.
inline constexpr std::size_t kSegmentCount = 23;
/// Six more joints carry a limb's swing without its twist, so that the twist spreads over the bone.
inline constexpr std::size_t kTwistJointCount = 6;
/// Joints of every skinned character: the segments, then the twist joints.
inline constexpr std::size_t kJointCount = kSegmentCount + kTwistJointCount;

enum Segment : std::uint8_t {
    Pelvis,
    L5,
    L3,
    T12,
    T8,
    Neck,
    Head,
    RightShoulder,
    RightUpperArm,
    RightForeArm,
    RightHand,
    LeftShoulder,
    LeftUpperArm,
    LeftForeArm,
    LeftHand,
    RightUpperLeg,
    RightLowerLeg,
    RightFoot,
    RightToe,
    LeftUpperLeg,
    LeftLowerLeg,
    LeftFoot,
    LeftToe
};

/// A joint that follows `segment` in position and swing, and leaves the twist about `axis` to it.
struct TwistJoint {
    Segment segment;
    /// The segment's long axis in its own frame.
    glm::vec3 axis;
};

/// Joint kSegmentCount + i is kTwistJoints[i].
inline constexpr std::array<TwistJoint, kTwistJointCount> kTwistJoints{{
    {RightUpperArm, {0.0F, 1.0F, 0.0F}},
    {LeftUpperArm, {0.0F, 1.0F, 0.0F}},
    {RightForeArm, {0.0F, 1.0F, 0.0F}},
    {LeftForeArm, {0.0F, 1.0F, 0.0F}},
    {RightUpperLeg, {0.0F, 0.0F, 1.0F}},
    {LeftUpperLeg, {0.0F, 0.0F, 1.0F}},
}};

/// The segment that a joint is or follows.
constexpr Segment jointSegment(std::size_t joint) {
    return joint < kSegmentCount ? static_cast<Segment>(joint) : kTwistJoints[joint - kSegmentCount].segment;
}

/// A segment's parent, or -1 for the pelvis.
inline constexpr std::array<int, kSegmentCount> kSegmentParents{-1, 0,  1,  2, 3,  4,  5,  4, 7,  8,  9, 4,
                                                                11, 12, 13, 0, 15, 16, 17, 0, 19, 20, 21};

inline constexpr std::array<std::string_view, kJointCount> kJointNames{"Pelvis",
                                                                       "L5",
                                                                       "L3",
                                                                       "T12",
                                                                       "T8",
                                                                       "Neck",
                                                                       "Head",
                                                                       "RightShoulder",
                                                                       "RightUpperArm",
                                                                       "RightForeArm",
                                                                       "RightHand",
                                                                       "LeftShoulder",
                                                                       "LeftUpperArm",
                                                                       "LeftForeArm",
                                                                       "LeftHand",
                                                                       "RightUpperLeg",
                                                                       "RightLowerLeg",
                                                                       "RightFoot",
                                                                       "RightToe",
                                                                       "LeftUpperLeg",
                                                                       "LeftLowerLeg",
                                                                       "LeftFoot",
                                                                       "LeftToe",
                                                                       "RightUpperArmTwist",
                                                                       "LeftUpperArmTwist",
                                                                       "RightForeArmTwist",
                                                                       "LeftForeArmTwist",
                                                                       "RightUpperLegTwist",
                                                                       "LeftUpperLegTwist"};

/// Segment origins in metres, Z-up, X forward, Y left.
using NullPose = std::array<glm::vec3, kSegmentCount>;

/// Stature in metres of the reference null pose.
inline constexpr float kReferenceStature = 1.75F;

/// The null pose that the mannequin was modelled in: a T-pose with identity orientations, standing on z = 0.
/// Ratios after Drillis and Contini, trunk and offsets after recorded MVN null poses.
inline constexpr NullPose kReferenceNullPose{{
    {0.0F, 0.0F, 0.9275F},        {0.0F, 0.0F, 1.0275F},       {0.0F, 0.0F, 1.1383F},
    {0.0F, 0.0F, 1.2394F},        {0.0F, 0.0F, 1.3404F},       {0.0F, 0.0F, 1.4817F},
    {0.0F, 0.0F, 1.5758F},        {0.0F, -0.0280F, 1.4196F},   {0.0F, -0.1650F, 1.4196F},
    {0.0F, -0.4500F, 1.4196F},    {0.0F, -0.6850F, 1.4196F},   {0.0F, 0.0280F, 1.4196F},
    {0.0F, 0.1650F, 1.4196F},     {0.0F, 0.4500F, 1.4196F},    {0.0F, 0.6850F, 1.4196F},
    {0.0F, -0.0840F, 0.9275F},    {0.0F, -0.0840F, 0.4990F},   {0.0F, -0.0840F, 0.0800F},
    {0.1480F, -0.0840F, 0.0150F}, {0.0F, 0.0840F, 0.9275F},    {0.0F, 0.0840F, 0.4990F},
    {0.0F, 0.0840F, 0.0800F},     {0.1480F, 0.0840F, 0.0150F},
}};

} // namespace posewire::render
