// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/hands.h"

#include "app/gui/viewport/overlays.h"
#include "core/model/body/segments.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string_view>

namespace posewire::gui {
namespace {

constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();
constexpr model::SegmentLayout kWithFingers{model::kBodySegmentCount, 0, model::kFingerSegmentCount};
static_assert(render::kHandSegmentCount == model::kHandSegmentCount);

/// Finger, by its name in scale messages.
const std::map<std::string_view, std::size_t>& fingersByName() {
    static const std::map<std::string_view, std::size_t> kFingers = [] {
        std::map<std::string_view, std::size_t> fingers;
        for (std::size_t finger = 0; finger < render::kFingerJointCount; ++finger) {
            fingers.emplace(
                model::segmentName(kWithFingers, model::kBodySegmentCount + static_cast<int>(finger)),
                finger);
        }
        return fingers;
    }();
    return kFingers;
}

const model::NullPose::Segment* find(const model::NullPose& pose, std::string_view name) {
    const auto found = std::ranges::find_if(
        pose.segments, [&](const auto& segment) { return segment.name.exact() == name; });
    return found == pose.segments.end() ? nullptr : &*found;
}

} // namespace

render::FingerPose PosedHands::left() const {
    constexpr std::size_t kCount = render::kHandSegmentCount;
    return hasLeft
               ? render::FingerPose{std::span(positions).first(kCount), std::span(orientations).first(kCount)}
               : render::FingerPose{};
}

render::FingerPose PosedHands::right() const {
    constexpr std::size_t kCount = render::kHandSegmentCount;
    return hasRight
               ? render::FingerPose{std::span(positions).last(kCount), std::span(orientations).last(kCount)}
               : render::FingerPose{};
}

PosedHands handsOf(const model::CharacterPose& pose) {
    PosedHands hands;
    const auto first = static_cast<std::size_t>(pose.layout.body + pose.layout.props);
    for (std::size_t i = 0; i < render::kFingerJointCount; ++i) {
        const std::size_t at = first + i;
        const bool isThere = i < static_cast<std::size_t>(pose.layout.fingers) && pose.isPresent(at);
        if (!isThere) {
            hands.positions[i] = glm::vec3(kAbsent);
            hands.orientations[i] = glm::quat(kAbsent, kAbsent, kAbsent, kAbsent);
            continue;
        }
        hands.positions[i] = pointOf(pose.segments[at].position);
        hands.orientations[i] = turnOf(pose.segments[at].orientation);
        (i < render::kHandSegmentCount ? hands.hasLeft : hands.hasRight) = true;
    }
    return hands;
}

render::FingerOrigins fingerOriginsOf(const model::NullPose& nullPose, const model::BodyOrigins& body) {
    render::FingerOrigins origins;
    origins.fill(glm::vec3(kAbsent));
    if (nullPose.segments.size() <= static_cast<std::size_t>(model::kBodySegmentCount)) {
        return origins;
    }
    const model::NullPose::Segment* leftHand = find(nullPose, "LeftHand");
    const model::NullPose::Segment* rightHand = find(nullPose, "RightHand");
    for (const model::NullPose::Segment& segment : nullPose.segments) {
        const auto known = fingersByName().find(segment.name.exact());
        if (known == fingersByName().end()) {
            continue;
        }
        const bool isLeft = known->second < render::kHandSegmentCount;
        const model::NullPose::Segment* hand = isLeft ? leftHand : rightHand;
        if (hand != nullptr) {
            const auto& place = body.places[isLeft ? model::segment::kLeftHand : model::segment::kRightHand];
            origins[known->second] = pointOf(place + segment.position - hand->position);
        }
    }
    return origins;
}

} // namespace posewire::gui
