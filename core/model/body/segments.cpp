// SPDX-License-Identifier: MIT
#include "core/model/body/segments.h"

#include <algorithm>
#include <string>

namespace posewire::model {
namespace {

using enum Side;
using namespace segment;

constexpr std::array<Segment, kBodySegmentCount> kBodyTable{{
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
constexpr std::array<HandSegment, kHandSegmentCount> kHand{{
    {"Carpus", -1},   {"FirstMC", 0},  {"FirstPP", 1},  {"FirstDP", 2},   {"SecondMC", 0},
    {"SecondPP", 4},  {"SecondMP", 5}, {"SecondDP", 6}, {"ThirdMC", 0},   {"ThirdPP", 8},
    {"ThirdMP", 9},   {"ThirdDP", 10}, {"FourthMC", 0}, {"FourthPP", 12}, {"FourthMP", 13},
    {"FourthDP", 14}, {"FifthMC", 0},  {"FifthPP", 16}, {"FifthMP", 17},  {"FifthDP", 18},
}};

constexpr std::array<std::string_view, kMaxPropCount> kPropNames{"Prop1", "Prop2", "Prop3", "Prop4"};

using HandNames = std::array<std::string, kHandSegmentCount>;

/// "LeftCarpus" and so on; in titles a space is before each word: "Left First MC".
HandNames handNames(std::string_view side, bool isTitle) {
    HandNames names;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string_view finger = kHand[i].name;
        const std::size_t bone = i == 0 || !isTitle ? finger.size() : finger.size() - 2;
        names[i].append(side).append(isTitle ? " " : "").append(finger.substr(0, bone));
        names[i].append(bone < finger.size() ? " " : "").append(finger.substr(bone));
    }
    return names;
}

/// The name or the title of each segment.
struct Naming {
    std::string_view Segment::*body;
    HandNames left;
    HandNames right;
};

std::string_view named(const Naming& naming, const SegmentLayout& layout, int position) {
    const auto place = placeOf(layout, position);
    const auto index = static_cast<std::size_t>(place ? place->index : 0);
    if (!place) {
        return {};
    }
    switch (place->kind) {
    case SegmentKind::Body:
        return kBodyTable[index].*naming.body;
    case SegmentKind::Prop:
        return kPropNames[index];
    case SegmentKind::LeftFinger:
        return naming.left[index];
    case SegmentKind::RightFinger:
        return naming.right[index];
    }
    return {};
}

struct Part {
    SegmentKind kind;
    int size;
    int known; ///< more have no name
};

std::array<Part, 4> partsOf(const SegmentLayout& layout) {
    return {{
        {SegmentKind::Body, layout.body, kBodySegmentCount},
        {SegmentKind::Prop, layout.props, kMaxPropCount},
        {SegmentKind::LeftFinger, kHandSegmentCount, kHandSegmentCount},
        {SegmentKind::RightFinger, kHandSegmentCount, kHandSegmentCount},
    }};
}

// Table "Unity3D" of the specification: legs, spine, left arm, right arm, head.
constexpr std::array<int, kBodySegmentCount> kUnityOrder{{
    kPelvis,
    kRightUpperLeg,
    kRightLowerLeg,
    kRightFoot,
    kRightToe,
    kLeftUpperLeg,
    kLeftLowerLeg,
    kLeftFoot,
    kLeftToe,
    kL5,
    kL3,
    kT12,
    kT8,
    kLeftShoulder,
    kLeftUpperArm,
    kLeftForeArm,
    kLeftHand,
    kRightShoulder,
    kRightUpperArm,
    kRightForeArm,
    kRightHand,
    kNeck,
    kHead,
}};

constexpr std::array<int, kBodySegmentCount> inverse(const std::array<int, kBodySegmentCount>& order) {
    std::array<int, kBodySegmentCount> places{};
    for (int place = 0; place < kBodySegmentCount; ++place) {
        places[static_cast<std::size_t>(order[static_cast<std::size_t>(place)])] = place;
    }
    return places;
}
constexpr std::array<int, kBodySegmentCount> kUnityPlaces = inverse(kUnityOrder);

} // namespace

const std::array<Segment, kBodySegmentCount>& bodySegments() {
    return kBodyTable;
}

std::size_t parentOf(std::size_t segment) {
    return static_cast<std::size_t>(kBodyTable[segment].parent);
}
const std::array<HandSegment, kHandSegmentCount>& handSegments() {
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
    for (const auto& [kind, size, known] : partsOf(layout)) {
        if (position < size) {
            return position < known ? std::optional(SegmentPlace{kind, position}) : std::nullopt;
        }
        position -= size;
    }
    return std::nullopt;
}

int positionIn(const SegmentLayout& layout, const SegmentPlace& place) {
    int before = 0;
    for (const auto& [kind, size, known] : partsOf(layout)) {
        if (kind == place.kind) {
            const int position = before + place.index;
            return place.index < size && position < layout.count() ? position : -1;
        }
        before += size;
    }
    return -1;
}

std::string_view segmentName(const SegmentLayout& layout, int position) {
    static const Naming names{&Segment::name, handNames("Left", false), handNames("Right", false)};
    return named(names, layout, position);
}

std::string_view segmentTitle(const SegmentLayout& layout, int position) {
    static const Naming titles{&Segment::displayName, handNames("Left", true), handNames("Right", true)};
    return named(titles, layout, position);
}

std::string_view segmentTitle(std::string_view sentName) {
    for (int position = 0; position < kAllSegments.count(); ++position) {
        if (segmentName(kAllSegments, position) == sentName) {
            return segmentTitle(kAllSegments, position);
        }
    }
    return {};
}

int segmentParent(const SegmentLayout& layout, int position) {
    const auto place = placeOf(layout, position);
    if (!place || place->kind == SegmentKind::Prop) {
        return -1;
    }
    const auto index = static_cast<std::size_t>(place->index);
    if (place->kind == SegmentKind::Body) {
        return kBodyTable[index].parent;
    }
    if (kHand[index].parent >= 0) {
        return position - place->index + kHand[index].parent;
    }
    const int hand = place->kind == SegmentKind::LeftFinger ? kLeftHand : kRightHand;
    return hand < layout.body ? hand : -1;
}

std::optional<int> findBodySegment(std::string_view name) {
    const auto found = std::ranges::find(kBodyTable, name, &Segment::name);
    return found == kBodyTable.end() ? std::nullopt
                                     : std::optional(static_cast<int>(found - kBodyTable.begin()));
}

int mirrored(int bodySegment) {
    constexpr int kArmLength = kLeftShoulder - kRightShoulder;
    constexpr int kLegLength = kLeftUpperLeg - kRightUpperLeg;
    const int length = bodySegment < kRightUpperLeg ? kArmLength : kLegLength;
    const Side side = kBodyTable[static_cast<std::size_t>(bodySegment)].side;
    return side == Centre ? bodySegment : bodySegment + (side == Right ? length : -length);
}

} // namespace posewire::model
