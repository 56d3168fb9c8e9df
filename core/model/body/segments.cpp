// SPDX-License-Identifier: MIT
#include "core/model/body/segments.h"

#include <algorithm>

namespace posewire::model {
namespace {

using enum Side;

constexpr std::array<Segment, kBodySegmentCount> kBody{{
    {1, "Pelvis", "Pelvis", -1, Centre},
    {2, "L5", "L5", 0, Centre},
    {3, "L3", "L3", 1, Centre},
    {4, "T12", "T12", 2, Centre},
    {5, "T8", "T8", 3, Centre},
    {6, "Neck", "Neck", 4, Centre},
    {7, "Head", "Head", 5, Centre},
    {8, "RightShoulder", "Right Shoulder", 4, Right},
    {9, "RightUpperArm", "Right Upper Arm", 7, Right},
    {10, "RightForeArm", "Right Forearm", 8, Right},
    {11, "RightHand", "Right Hand", 9, Right},
    {12, "LeftShoulder", "Left Shoulder", 4, Left},
    {13, "LeftUpperArm", "Left Upper Arm", 11, Left},
    {14, "LeftForeArm", "Left Forearm", 12, Left},
    {15, "LeftHand", "Left Hand", 13, Left},
    {16, "RightUpperLeg", "Right Upper Leg", 0, Right},
    {17, "RightLowerLeg", "Right Lower Leg", 15, Right},
    {18, "RightFoot", "Right Foot", 16, Right},
    {19, "RightToe", "Right Toe", 17, Right},
    {20, "LeftUpperLeg", "Left Upper Leg", 0, Left},
    {21, "LeftLowerLeg", "Left Lower Leg", 19, Left},
    {22, "LeftFoot", "Left Foot", 20, Left},
    {23, "LeftToe", "Left Toe", 21, Left},
}};

// Metacarpals hang on the carpus, as in the Unreal plug-in; the bones of a finger form a chain.
constexpr std::array<Segment, kHandSegmentCount> kHand{{
    {1, "Carpus", "Carpus", -1, Centre},       {2, "FirstMC", "First MC", 0, Centre},
    {3, "FirstPP", "First PP", 1, Centre},     {4, "FirstDP", "First DP", 2, Centre},
    {5, "SecondMC", "Second MC", 0, Centre},   {6, "SecondPP", "Second PP", 4, Centre},
    {7, "SecondMP", "Second MP", 5, Centre},   {8, "SecondDP", "Second DP", 6, Centre},
    {9, "ThirdMC", "Third MC", 0, Centre},     {10, "ThirdPP", "Third PP", 8, Centre},
    {11, "ThirdMP", "Third MP", 9, Centre},    {12, "ThirdDP", "Third DP", 10, Centre},
    {13, "FourthMC", "Fourth MC", 0, Centre},  {14, "FourthPP", "Fourth PP", 12, Centre},
    {15, "FourthMP", "Fourth MP", 13, Centre}, {16, "FourthDP", "Fourth DP", 14, Centre},
    {17, "FifthMC", "Fifth MC", 0, Centre},    {18, "FifthPP", "Fifth PP", 16, Centre},
    {19, "FifthMP", "Fifth MP", 17, Centre},   {20, "FifthDP", "Fifth DP", 18, Centre},
}};

constexpr std::array<std::string_view, kMaxPropCount> kPropNames{"Prop1", "Prop2", "Prop3", "Prop4"};
constexpr std::array<std::string_view, kMaxPropCount> kPropDisplayNames{"Prop 1", "Prop 2", "Prop 3",
                                                                        "Prop 4"};
constexpr std::array<std::string_view, kHandSegmentCount> kLeftFingerNames{
    "LeftCarpus",   "LeftFirstMC",  "LeftFirstPP",  "LeftFirstDP",  "LeftSecondMC",
    "LeftSecondPP", "LeftSecondMP", "LeftSecondDP", "LeftThirdMC",  "LeftThirdPP",
    "LeftThirdMP",  "LeftThirdDP",  "LeftFourthMC", "LeftFourthPP", "LeftFourthMP",
    "LeftFourthDP", "LeftFifthMC",  "LeftFifthPP",  "LeftFifthMP",  "LeftFifthDP"};
constexpr std::array<std::string_view, kHandSegmentCount> kLeftFingerDisplayNames{
    "Left Carpus",    "Left First MC",  "Left First PP",  "Left First DP",  "Left Second MC",
    "Left Second PP", "Left Second MP", "Left Second DP", "Left Third MC",  "Left Third PP",
    "Left Third MP",  "Left Third DP",  "Left Fourth MC", "Left Fourth PP", "Left Fourth MP",
    "Left Fourth DP", "Left Fifth MC",  "Left Fifth PP",  "Left Fifth MP",  "Left Fifth DP"};
constexpr std::array<std::string_view, kHandSegmentCount> kRightFingerNames{
    "RightCarpus",   "RightFirstMC",  "RightFirstPP",  "RightFirstDP",  "RightSecondMC",
    "RightSecondPP", "RightSecondMP", "RightSecondDP", "RightThirdMC",  "RightThirdPP",
    "RightThirdMP",  "RightThirdDP",  "RightFourthMC", "RightFourthPP", "RightFourthMP",
    "RightFourthDP", "RightFifthMC",  "RightFifthPP",  "RightFifthMP",  "RightFifthDP"};
constexpr std::array<std::string_view, kHandSegmentCount> kRightFingerDisplayNames{
    "Right Carpus",    "Right First MC",  "Right First PP",  "Right First DP",  "Right Second MC",
    "Right Second PP", "Right Second MP", "Right Second DP", "Right Third MC",  "Right Third PP",
    "Right Third MP",  "Right Third DP",  "Right Fourth MC", "Right Fourth PP", "Right Fourth MP",
    "Right Fourth DP", "Right Fifth MC",  "Right Fifth PP",  "Right Fifth MP",  "Right Fifth DP"};

// Table "Unity3D" of the specification: legs, spine, left arm, right arm, head.
constexpr std::array<int, kBodySegmentCount> kUnityOrder{segment::kPelvis,
                                                         segment::kRightUpperLeg,
                                                         segment::kRightLowerLeg,
                                                         segment::kRightFoot,
                                                         segment::kRightToe,
                                                         segment::kLeftUpperLeg,
                                                         segment::kLeftLowerLeg,
                                                         segment::kLeftFoot,
                                                         segment::kLeftToe,
                                                         segment::kL5,
                                                         segment::kL3,
                                                         segment::kT12,
                                                         segment::kT8,
                                                         segment::kLeftShoulder,
                                                         segment::kLeftUpperArm,
                                                         segment::kLeftForeArm,
                                                         segment::kLeftHand,
                                                         segment::kRightShoulder,
                                                         segment::kRightUpperArm,
                                                         segment::kRightForeArm,
                                                         segment::kRightHand,
                                                         segment::kNeck,
                                                         segment::kHead};

constexpr std::array<int, kBodySegmentCount> inverse(const std::array<int, kBodySegmentCount>& order) {
    std::array<int, kBodySegmentCount> places{};
    for (int place = 0; place < kBodySegmentCount; ++place) {
        places[static_cast<std::size_t>(order[static_cast<std::size_t>(place)])] = place;
    }
    return places;
}
constexpr std::array<int, kBodySegmentCount> kUnityPlaces = inverse(kUnityOrder);

template <std::size_t size>
std::string_view at(const std::array<std::string_view, size>& names, int index) {
    return names[static_cast<std::size_t>(index)];
}

} // namespace

const std::array<Segment, kBodySegmentCount>& bodySegments() {
    return kBody;
}
const std::array<Segment, kHandSegmentCount>& handSegments() {
    return kHand;
}
const std::array<int, kBodySegmentCount>& unityOrder() {
    return kUnityOrder;
}
const std::array<int, kBodySegmentCount>& unityPlaces() {
    return kUnityPlaces;
}

std::optional<SegmentPlace> placeOf(const SegmentLayout& layout, int position) {
    if (position < 0 || position >= layout.count()) {
        return std::nullopt;
    }
    if (position < layout.body) {
        return position < kBodySegmentCount ? std::optional(SegmentPlace{SegmentKind::Body, position})
                                            : std::nullopt;
    }
    const int afterBody = position - layout.body;
    if (afterBody < layout.props) {
        return afterBody < kMaxPropCount ? std::optional(SegmentPlace{SegmentKind::Prop, afterBody})
                                         : std::nullopt;
    }
    const int finger = afterBody - layout.props;
    if (finger < kHandSegmentCount) {
        return SegmentPlace{SegmentKind::LeftFinger, finger};
    }
    if (finger < kFingerSegmentCount) {
        return SegmentPlace{SegmentKind::RightFinger, finger - kHandSegmentCount};
    }
    return std::nullopt;
}

std::string_view segmentName(const SegmentLayout& layout, int position) {
    const auto place = placeOf(layout, position);
    if (!place) {
        return {};
    }
    switch (place->kind) {
    case SegmentKind::Body:
        return kBody[static_cast<std::size_t>(place->index)].name;
    case SegmentKind::Prop:
        return at(kPropNames, place->index);
    case SegmentKind::LeftFinger:
        return at(kLeftFingerNames, place->index);
    case SegmentKind::RightFinger:
        return at(kRightFingerNames, place->index);
    }
    return {};
}

std::string_view segmentDisplayName(const SegmentLayout& layout, int position) {
    const auto place = placeOf(layout, position);
    if (!place) {
        return {};
    }
    switch (place->kind) {
    case SegmentKind::Body:
        return kBody[static_cast<std::size_t>(place->index)].displayName;
    case SegmentKind::Prop:
        return at(kPropDisplayNames, place->index);
    case SegmentKind::LeftFinger:
        return at(kLeftFingerDisplayNames, place->index);
    case SegmentKind::RightFinger:
        return at(kRightFingerDisplayNames, place->index);
    }
    return {};
}

int segmentParent(const SegmentLayout& layout, int position) {
    const auto place = placeOf(layout, position);
    if (!place || place->kind == SegmentKind::Prop) {
        return -1;
    }
    if (place->kind == SegmentKind::Body) {
        return kBody[static_cast<std::size_t>(place->index)].parent;
    }
    const bool left = place->kind == SegmentKind::LeftFinger;
    const int parent = kHand[static_cast<std::size_t>(place->index)].parent;
    if (parent < 0) {
        const int hand = left ? segment::kLeftHand : segment::kRightHand;
        return hand < layout.body ? hand : -1;
    }
    return layout.body + layout.props + (left ? 0 : kHandSegmentCount) + parent;
}

std::optional<int> findBodySegment(std::string_view name) {
    const auto found = std::ranges::find(kBody, name, &Segment::name);
    return found == kBody.end() ? std::nullopt : std::optional(static_cast<int>(found - kBody.begin()));
}

int mirrored(int bodySegment) {
    using namespace segment;
    constexpr int kArmLength = kLeftShoulder - kRightShoulder;
    constexpr int kLegLength = kLeftUpperLeg - kRightUpperLeg;
    switch (kBody[static_cast<std::size_t>(bodySegment)].side) {
    case Centre:
        return bodySegment;
    case Right:
        return bodySegment + (bodySegment < kRightUpperLeg ? kArmLength : kLegLength);
    case Left:
        return bodySegment - (bodySegment < kRightUpperLeg ? kArmLength : kLegLength);
    }
    return bodySegment;
}

} // namespace posewire::model
