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
/// Four more make half of the swing at shoulders and hips, where flesh would bulge or crack otherwise.
inline constexpr std::size_t kHalfJointCount = 4;
/// The 20 finger segments of MVN for each hand, the left hand first.
inline constexpr std::size_t kHandSegmentCount = 20;
inline constexpr std::size_t kFingerJointCount = 2 * kHandSegmentCount;

inline constexpr std::size_t kFirstHalfJoint = kSegmentCount + kTwistJointCount;
inline constexpr std::size_t kFirstFingerJoint = kFirstHalfJoint + kHalfJointCount;
/// Joints of every skinned character: the segments, the twist joints, the half joints, the fingers.
inline constexpr std::size_t kJointCount = kFirstFingerJoint + kFingerJointCount;

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

/// Joint kFirstHalfJoint + i stands between this segment and its parent.
inline constexpr std::array<Segment, kHalfJointCount> kHalfJoints{RightUpperArm, LeftUpperArm, RightUpperLeg,
                                                                  LeftUpperLeg};

/// The body's segment that a joint is or follows; fingers follow their hand.
constexpr Segment jointSegment(std::size_t joint) {
    if (joint < kSegmentCount) {
        return static_cast<Segment>(joint);
    }
    if (joint < kFirstHalfJoint) {
        return kTwistJoints[joint - kSegmentCount].segment;
    }
    if (joint < kFirstFingerJoint) {
        return kHalfJoints[joint - kFirstHalfJoint];
    }
    return joint < kFirstFingerJoint + kHandSegmentCount ? LeftHand : RightHand;
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
                                                                       "LeftUpperLegTwist",
                                                                       "RightUpperArmHalf",
                                                                       "LeftUpperArmHalf",
                                                                       "RightUpperLegHalf",
                                                                       "LeftUpperLegHalf",
                                                                       "LeftCarpus",
                                                                       "LeftFirstMC",
                                                                       "LeftFirstPP",
                                                                       "LeftFirstDP",
                                                                       "LeftSecondMC",
                                                                       "LeftSecondPP",
                                                                       "LeftSecondMP",
                                                                       "LeftSecondDP",
                                                                       "LeftThirdMC",
                                                                       "LeftThirdPP",
                                                                       "LeftThirdMP",
                                                                       "LeftThirdDP",
                                                                       "LeftFourthMC",
                                                                       "LeftFourthPP",
                                                                       "LeftFourthMP",
                                                                       "LeftFourthDP",
                                                                       "LeftFifthMC",
                                                                       "LeftFifthPP",
                                                                       "LeftFifthMP",
                                                                       "LeftFifthDP",
                                                                       "RightCarpus",
                                                                       "RightFirstMC",
                                                                       "RightFirstPP",
                                                                       "RightFirstDP",
                                                                       "RightSecondMC",
                                                                       "RightSecondPP",
                                                                       "RightSecondMP",
                                                                       "RightSecondDP",
                                                                       "RightThirdMC",
                                                                       "RightThirdPP",
                                                                       "RightThirdMP",
                                                                       "RightThirdDP",
                                                                       "RightFourthMC",
                                                                       "RightFourthPP",
                                                                       "RightFourthMP",
                                                                       "RightFourthDP",
                                                                       "RightFifthMC",
                                                                       "RightFifthPP",
                                                                       "RightFifthMP",
                                                                       "RightFifthDP"};

/// A segment of a hand by its parent in the hand, or -1 for the carpus, whose parent is the hand.
inline constexpr std::array<int, kHandSegmentCount> kFingerParents{-1, 0,  1, 2,  0,  4,  5, 6,  0,  8,
                                                                   9,  10, 0, 12, 13, 14, 0, 16, 17, 18};

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

/// Origins of both hands' segments, the left hand first.
using FingerOrigins = std::array<glm::vec3, kFingerJointCount>;

/// Origins of the left hand's segments in the reference null pose; the right hand's are their mirror image.
inline constexpr std::array<glm::vec3, kHandSegmentCount> kReferenceHand{{
    {0.0000F, 0.6850F, 1.4196F},  {0.0190F, 0.7040F, 1.4126F},  {0.0480F, 0.7350F, 1.4066F},
    {0.0650F, 0.7605F, 1.4031F},  {0.0165F, 0.7065F, 1.4196F},  {0.0325F, 0.7710F, 1.4171F},
    {0.0376F, 0.8106F, 1.4147F},  {0.0405F, 0.8348F, 1.4121F},  {0.0045F, 0.7065F, 1.4196F},
    {0.0112F, 0.7760F, 1.4171F},  {0.0127F, 0.8199F, 1.4145F},  {0.0136F, 0.8472F, 1.4115F},
    {-0.0080F, 0.7065F, 1.4196F}, {-0.0105F, 0.7730F, 1.4171F}, {-0.0127F, 0.8134F, 1.4147F},
    {-0.0140F, 0.8392F, 1.4118F}, {-0.0185F, 0.7065F, 1.4196F}, {-0.0305F, 0.7640F, 1.4171F},
    {-0.0356F, 0.7950F, 1.4152F}, {-0.0385F, 0.8142F, 1.4131F},
}};

/// Where the skin of the left hand's thumb and fingers ends.
inline constexpr std::array<glm::vec3, 5> kReferenceFingertips{{
    {0.0775F, 0.7815F, 1.4001F},
    {0.0427F, 0.8564F, 1.4084F},
    {0.0142F, 0.8704F, 1.4075F},
    {-0.0150F, 0.8613F, 1.4081F},
    {-0.0410F, 0.8333F, 1.4099F},
}};

/// Where a joint is in the reference null pose.
constexpr glm::vec3 jointOrigin(std::size_t joint) {
    if (joint < kFirstFingerJoint) {
        return kReferenceNullPose[jointSegment(joint)];
    }
    const std::size_t finger = joint - kFirstFingerJoint;
    const glm::vec3& left = kReferenceHand[finger % kHandSegmentCount];
    return finger < kHandSegmentCount ? left : glm::vec3(left.x, -left.y, left.z);
}

/// The joint that a joint hangs on, or -1 for the pelvis.
constexpr int jointParent(std::size_t joint) {
    if (joint < kFirstFingerJoint) {
        return kSegmentParents[jointSegment(joint)];
    }
    const std::size_t finger = joint - kFirstFingerJoint;
    const int parent = kFingerParents[finger % kHandSegmentCount];
    return parent < 0 ? jointSegment(joint) : static_cast<int>(joint - finger % kHandSegmentCount) + parent;
}

} // namespace posewire::render
