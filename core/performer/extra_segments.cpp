// SPDX-License-Identifier: MIT
#include "core/performer/extra_segments.h"

#include <array>

namespace posewire::performer {
namespace {

using Eigen::Vector3d;
using model::SegmentKind;
using model::SegmentPose;
using namespace model::segment;

/// Where the bones of a left hand begin, relative to the wrist on the 1.75 m body, palm down, fingers along
/// y, thumb forward.
constexpr std::array<std::array<double, 3>, model::kHandSegmentCount> kBones{{
    {0.000, 0.000, 0.000},   {0.018, 0.020, -0.006},  {0.038, 0.050, -0.012},  {0.050, 0.080, -0.016},
    {0.016, 0.022, 0.000},   {0.030, 0.090, -0.002},  {0.032, 0.128, -0.004},  {0.033, 0.152, -0.006},
    {0.004, 0.022, 0.002},   {0.009, 0.094, 0.000},   {0.009, 0.136, -0.002},  {0.009, 0.163, -0.004},
    {-0.008, 0.021, 0.001},  {-0.011, 0.088, -0.001}, {-0.013, 0.126, -0.003}, {-0.014, 0.151, -0.005},
    {-0.018, 0.020, -0.002}, {-0.029, 0.078, -0.004}, {-0.032, 0.108, -0.006}, {-0.034, 0.127, -0.008},
}};

struct PropMount {
    std::string_view name;
    int segment;
    std::array<double, 3> place; ///< on the 1.75 m body
};
constexpr std::array<PropMount, model::kMaxPropCount> kProps{{
    {"Sword", kRightHand, {0.02, -0.08, -0.02}},
    {"Crutch", kLeftHand, {0.02, 0.08, -0.02}},
    {"Generic", kT8, {-0.16, 0.0, 0.02}},
    {"Golfclub", kPelvis, {0.0, 0.17, 0.02}},
}};

Vector3d toVector(const std::array<double, 3>& values) {
    return {values[0], values[1], values[2]};
}

Vector3d boneOrigin(int index, double side) {
    return toVector(kBones[static_cast<std::size_t>(index)]).cwiseProduct(Vector3d(1.0, side, 1.0));
}

/// Metacarpals stay flat; the thumb closes across the palm, the fingers bend joint by joint.
Eigen::Quaterniond boneRotation(int index, double side, double curl) {
    constexpr int kThumbEnd = 3;
    constexpr int kBonesPerFinger = 4;
    if (index == 0) {
        return Eigen::Quaterniond::Identity();
    }
    if (index <= kThumbEnd) {
        return aboutZ(side * 12.0 * curl) * aboutX(-side * 14.0 * curl);
    }
    const bool isMetacarpal = (index - kThumbEnd - 1) % kBonesPerFinger == 0;
    return isMetacarpal ? Eigen::Quaterniond::Identity() : aboutX(-side * 80.0 * curl);
}

} // namespace

std::string_view propName(int prop) {
    return kProps[static_cast<std::size_t>(prop)].name;
}

void ExtraSegments::append(const model::ReferenceBody& body, double curl,
                           std::vector<SegmentPose>& poses) const {
    const double scale = body.stature / model::kReferenceStature;
    for (int position = layout.body; position < layout.count(); ++position) {
        const model::SegmentPlace place = *model::placeOf(layout, position);
        if (place.kind == SegmentKind::Prop) {
            const PropMount& mount = kProps[static_cast<std::size_t>(place.index)];
            const SegmentPose& carrier = poses[static_cast<std::size_t>(mount.segment)];
            poses.push_back(
                model::composed(carrier, {scale * toVector(mount.place), Eigen::Quaterniond::Identity()}));
            continue;
        }
        const double side = place.kind == SegmentKind::LeftFinger ? 1.0 : -1.0;
        const int parentBone = model::handSegments()[static_cast<std::size_t>(place.index)].parent;
        const Vector3d from = parentBone < 0 ? Vector3d::Zero() : boneOrigin(parentBone, side);
        const auto parent = static_cast<std::size_t>(model::segmentParent(layout, position));
        poses.push_back(model::composed(poses[parent], {scale * (boneOrigin(place.index, side) - from),
                                                        boneRotation(place.index, side, curl)}));
    }
}

void ExtraSegments::appendNullPose(const model::ReferenceBody& body, std::vector<Vector3d>& origins) const {
    std::vector<SegmentPose> poses(origins.size());
    for (std::size_t index = 0; index < origins.size(); ++index) {
        poses[index].position = origins[index];
    }
    append(body, 0.0, poses);
    for (std::size_t index = origins.size(); index < poses.size(); ++index) {
        origins.push_back(poses[index].position);
    }
}

} // namespace posewire::performer
