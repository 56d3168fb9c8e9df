// SPDX-License-Identifier: MIT
#include "core/model/content/conventions.h"

#include "core/model/body/segments.h"

#include <algorithm>

namespace posewire::model {
namespace {

using K = words::Kind;

/// Good streams are off by 0.03 to 2.6 mm, wrong ones by 237 to 572 mm.
constexpr double kWrong = 0.12;
constexpr double kFits = 0.05;

Eigen::Vector3d reflected(Eigen::Vector3d place, int axis) {
    place[axis] = -place[axis];
    return place;
}

/// The turn as it is in a mirror: about its axis reflected, the other way round.
Eigen::Quaterniond reflected(const Eigen::Quaterniond& turn, int axis) {
    Eigen::Quaterniond mirrored(turn.w(), -turn.x(), -turn.y(), -turn.z());
    mirrored.coeffs()[axis] = turn.coeffs()[axis];
    return mirrored;
}

template <int Axis>
SegmentPose inMirror(const SegmentPose& one) {
    return {reflected(one.position, Axis), reflected(one.orientation, Axis)};
}

template <int Axis>
SegmentPose placeInMirror(const SegmentPose& one) {
    return {reflected(one.position, Axis), one.orientation};
}

struct Reading {
    K looks;
    SegmentPose (*read)(const SegmentPose& one);
};

/// Those of one fit are in the order in which they are believed.
constexpr std::array<Reading, ConventionFit::kReadings> kReadingTable{{
    {K::Nothing, [](const SegmentPose& one) { return one; }},
    // Allowed: the specification has Y up, too.
    {K::Nothing,
     [](const SegmentPose& one) {
         return SegmentPose{zUpFromYUp(one.position), zUpFromYUp(one.orientation)};
     }},
    {K::QuaternionXyzw,
     [](const SegmentPose& one) {
         const Eigen::Quaterniond& q = one.orientation; // read as w x y z
         return SegmentPose{one.position, {q.z(), q.w(), q.x(), q.y()}};
     }},
    {K::QuaternionInverse,
     [](const SegmentPose& one) {
         return SegmentPose{one.position, one.orientation.conjugate()};
     }},
    {K::UnityAxes,
     [](const SegmentPose& one) {
         return SegmentPose{zUpFromUnity(one.position), zUpFromUnity(one.orientation)};
     }},
    // On a symmetric body this leaves the same residual as swapped sides.
    {K::AllMirrored, inMirror<1>},
    {K::AllMirrored, inMirror<0>},
    {K::AllMirrored, inMirror<2>},
    {K::PlacesMirrored, placeInMirror<1>},
    {K::PlacesMirrored, placeInMirror<0>},
    {K::PlacesMirrored, placeInMirror<2>},
}};

/// What nine of ten joints are off by at most.
double residualOf(std::span<const SegmentPose> segments, const BodyOrigins& nullPose, double scale,
                  const Reading& reading) {
    std::array<double, kBodySegments - 1> off{};
    for (std::size_t child = 1; child < kBodySegments; ++child) {
        const std::size_t parent = parentOf(child);
        const SegmentPose from = reading.read(segments[parent]);
        const Eigen::Vector3d bone = scale * (nullPose.places[child] - nullPose.places[parent]);
        off[child - 1] =
            (reading.read(segments[child]).position - from.position - from.orientation * bone).norm();
    }
    const auto most = off.begin() + static_cast<std::ptrdiff_t>(off.size() * 9 / 10);
    std::ranges::nth_element(off, most);
    return *most;
}

} // namespace

void ConventionFit::add(std::span<const SegmentPose> segments, const BodyOrigins& nullPose, double scale) {
    if (segments.size() < kBodySegments) {
        return;
    }
    ++m_poses;
    for (std::size_t i = 0; i < kReadings; ++i) {
        m_sums[i] += residualOf(segments, nullPose, scale, kReadingTable[i]);
    }
}

bool ConventionFit::isRight() const {
    return std::min(m_sums[0], m_sums[1]) <= kWrong * m_poses;
}

words::Kind ConventionFit::looks() const {
    const auto least = std::ranges::min_element(m_sums) - m_sums.begin();
    return m_sums[static_cast<std::size_t>(least)] <= kFits * m_poses
               ? kReadingTable[static_cast<std::size_t>(least)].looks
               : K::Nothing;
}

} // namespace posewire::model
