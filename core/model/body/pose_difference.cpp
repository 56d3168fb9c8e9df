// SPDX-License-Identifier: MIT
#include "core/model/body/pose_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace posewire::model {
namespace {

constexpr double kMillimetres = 1000.0; // in a metre

bool isKnown(const CharacterPose& pose, int position) {
    const auto place = static_cast<std::size_t>(position);
    return position >= 0 && pose.isPresent(place) && place < pose.segments.size() &&
           pose.sources[place].weaker() >= Provenance::Solved;
}

/// As it was sent.
SegmentPose sentPose(const CharacterPose& pose, int position) {
    SegmentPose segment = pose.segments[static_cast<std::size_t>(position)];
    segment.position -= pose.moved;
    return segment;
}

/// -1 for none.
std::array<int, kMaxSegmentCount> positionsOf(const CharacterPose& pose) {
    std::array<int, kMaxSegmentCount> positions{};
    positions.fill(-1);
    for (int position = 0; position < pose.layout.count(); ++position) {
        const auto place = placeOf(pose.layout, position);
        if (place && isKnown(pose, position)) {
            positions[static_cast<std::size_t>(slotOf(*place))] = position;
        }
    }
    return positions;
}

/// Turned about the vertical alone, on the floor.
SegmentPose onFloor(const SegmentPose& pelvis) {
    return {{pelvis.position.x(), pelvis.position.y(), 0}, headingOf(pelvis.orientation)};
}

SegmentPose inverseOf(const SegmentPose& motion) {
    const Eigen::Quaterniond back = motion.orientation.conjugate();
    return {back * -motion.position, back};
}

/// From the second body to the first; nothing if a pelvis is missing.
std::optional<SegmentPose> overlayOf(const CharacterPose& first, const CharacterPose& second,
                                     DifferenceFrame frame) {
    if (frame == DifferenceFrame::World) {
        return SegmentPose{};
    }
    if (!isKnown(first, segment::kPelvis) || !isKnown(second, segment::kPelvis)) {
        return std::nullopt;
    }
    SegmentPose to = sentPose(first, segment::kPelvis);
    SegmentPose from = sentPose(second, segment::kPelvis);
    if (frame == DifferenceFrame::Heading) {
        to = onFloor(to);
        from = onFloor(from);
    }
    return composed(to, inverseOf(from));
}

template <class Read>
double meanOf(const std::vector<SegmentDifference>& segments, Read read) {
    double sum = 0;
    for (const SegmentDifference& one : segments) {
        sum += read(one);
    }
    return segments.empty() ? 0 : sum / static_cast<double>(segments.size());
}

} // namespace

const SegmentDifference* PoseDifference::find(int slot) const {
    const auto found = std::ranges::find(segments, slot, &SegmentDifference::slot);
    return found == segments.end() ? nullptr : &*found;
}

double PoseDifference::meanMillimetres() const {
    return meanOf(segments, [](const SegmentDifference& one) { return one.millimetres; });
}

double PoseDifference::meanDegrees() const {
    return meanOf(segments, [](const SegmentDifference& one) { return one.degrees; });
}

double degreesBetween(const Eigen::Quaterniond& first, const Eigen::Quaterniond& second) {
    const Eigen::Quaterniond turn = first.conjugate() * second;
    return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) * 180 / std::numbers::pi;
}

bool differenceOf(const CharacterPose& first, const CharacterPose& second, DifferenceFrame frame,
                  PoseDifference& difference) {
    difference.segments.clear();
    difference.overlay = {};
    if (first.isObjects || second.isObjects) {
        return false;
    }
    const auto overlay = overlayOf(first, second, frame);
    if (!overlay) {
        return false;
    }
    difference.overlay = *overlay;
    const auto inFirst = positionsOf(first);
    const auto inSecond = positionsOf(second);
    for (std::size_t slot = 0; slot < inFirst.size(); ++slot) {
        if (inFirst[slot] < 0 || inSecond[slot] < 0) {
            continue;
        }
        const SegmentPose one = sentPose(first, inFirst[slot]);
        const SegmentPose other = composed(*overlay, sentPose(second, inSecond[slot]));
        difference.segments.push_back({static_cast<int>(slot), inFirst[slot], inSecond[slot],
                                       kMillimetres * (other.position - one.position).norm(),
                                       degreesBetween(one.orientation, other.orientation)});
    }
    return !difference.segments.empty();
}

} // namespace posewire::model
