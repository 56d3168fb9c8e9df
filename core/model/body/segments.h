// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace posewire::model {

inline constexpr int kBodySegmentCount = 23;
/// The same, for sizes and places.
inline constexpr std::size_t kBodySegments = kBodySegmentCount;
inline constexpr int kMaxPropCount = 4;
inline constexpr int kHandSegmentCount = 20;
inline constexpr int kFingerSegmentCount = 2 * kHandSegmentCount;
/// Body, four props and both hands: the most items a pose datagram can hold.
inline constexpr int kMaxSegmentCount = kBodySegmentCount + kMaxPropCount + kFingerSegmentCount;

/// Positions of the body segments in a pose datagram, 0-based. The wire's segment ID is this plus one.
namespace segment {
enum Index : int {
    kPelvis,
    kL5,
    kL3,
    kT12,
    kT8,
    kNeck,
    kHead,
    kRightShoulder,
    kRightUpperArm,
    kRightForeArm,
    kRightHand,
    kLeftShoulder,
    kLeftUpperArm,
    kLeftForeArm,
    kLeftHand,
    kRightUpperLeg,
    kRightLowerLeg,
    kRightFoot,
    kRightToe,
    kLeftUpperLeg,
    kLeftLowerLeg,
    kLeftFoot,
    kLeftToe,
};
} // namespace segment

enum class Side : std::uint8_t { Centre, Right, Left };

/// A segment of the body.
struct Segment {
    int id = 0;                   ///< on the wire, 1-based
    std::string_view name;        ///< as sent in type 13: "RightUpperArm"
    std::string_view displayName; ///< in the specification's tables: "Right Upper Arm"
    int parent = -1;              ///< 0-based position of the parent, -1 for the pelvis
    Side side = Side::Centre;
};

/// The 23 body segments in wire order (Table 1 of the specification; parents as in every known receiver).
const std::array<Segment, kBodySegmentCount>& bodySegments();

/// Of a body segment that has one: all but the pelvis.
std::size_t parentOf(std::size_t segment);

/// A segment of one hand.
struct HandSegment {
    std::string_view name; ///< without the side: "Carpus", "FirstMC" … "FifthDP"
    int parent = -1;       ///< within the hand; -1 for the hand segment of the body
};
const std::array<HandSegment, kHandSegmentCount>& handSegments();

/// Body segment index at each place of a type 05 (Unity3D) datagram, and the inverse.
const std::array<int, kBodySegmentCount>& unityOrder();
const std::array<int, kBodySegmentCount>& unityPlaces();

/// Which items a pose datagram holds: body, props, left hand, right hand, in this order; absent parts are
/// skipped.
struct SegmentLayout {
    int body = kBodySegmentCount;
    int props = 0;
    int fingers = 0; ///< 0, 20 (left hand only) or 40

    constexpr int count() const { return body + props + fingers; }
    friend constexpr bool operator==(const SegmentLayout&, const SegmentLayout&) = default;
};

/// Every segment that a body can have.
inline constexpr SegmentLayout kAllSegments{kBodySegmentCount, kMaxPropCount, kFingerSegmentCount};

enum class SegmentKind : std::uint8_t { Body, Prop, LeftFinger, RightFinger };

struct SegmentPlace {
    SegmentKind kind = SegmentKind::Body;
    int index = 0; ///< within the kind: body segment, prop number, or place in the hand
};

/// Position of a segment in a layout; -1 if it has none.
[[nodiscard]] int positionIn(const SegmentLayout& layout, const SegmentPlace& place);

/// Where a segment is in kAllSegments: the same for all bodies, whatever else was sent of them.
[[nodiscard]] inline int slotOf(const SegmentPlace& place) {
    return positionIn(kAllSegments, place);
}

/// Judged by position, since the numbering of props differs between revisions. Empty outside the layout.
std::optional<SegmentPlace> placeOf(const SegmentLayout& layout, int position);

/// As sent in type 13, and as a word of filters: "RightUpperArm", "Prop1", "LeftFirstPP"; empty outside the
/// layout.
std::string_view segmentName(const SegmentLayout& layout, int position);

/// What people read: the specification's "Right Upper Arm", "Prop1", "Left First PP"; empty outside the
/// layout.
std::string_view segmentTitle(const SegmentLayout& layout, int position);
/// The same by the name that was sent; empty if that is none of these.
std::string_view segmentTitle(std::string_view sentName);

/// Position of the parent item; -1 for the pelvis, for props (they are free in space) and outside the layout.
int segmentParent(const SegmentLayout& layout, int position);

/// Body segment index of a type 13 name; empty for fingers, props and unknown names.
std::optional<int> findBodySegment(std::string_view name);

/// Centre segments are their own mirror.
int mirrored(int bodySegment);

} // namespace posewire::model
