// SPDX-License-Identifier: MIT
#include "core/performer/body_pose.h"

#include <cmath>

namespace posewire::performer {

using Eigen::Quaterniond;

namespace {

double half(double degrees) {
    return 0.5 * degrees * model::kRadiansPerDegree;
}

} // namespace

BodyPose posed(const model::ReferenceBody& body, const Eigen::Vector3d& root,
               const LocalRotations& rotations) {
    BodyPose pose;
    pose[0] = {root, rotations[0]};
    poseRange(body, rotations, {1, model::kBodySegmentCount - 1}, pose);
    return pose;
}

void poseRange(const model::ReferenceBody& body, const LocalRotations& rotations, SegmentRange range,
               BodyPose& pose) {
    const auto& segments = model::bodySegments();
    for (int index = range.first; index <= range.last; ++index) {
        const auto place = static_cast<std::size_t>(index);
        const auto parent = static_cast<std::size_t>(segments[place].parent);
        pose[place] = model::composed(pose[parent],
                                      {body.origins[place] - body.origins[parent], rotations.values[place]});
    }
}

Quaterniond aboutX(double degrees) {
    return {std::cos(half(degrees)), std::sin(half(degrees)), 0.0, 0.0};
}

Quaterniond aboutY(double degrees) {
    return {std::cos(half(degrees)), 0.0, std::sin(half(degrees)), 0.0};
}

Quaterniond aboutZ(double degrees) {
    return {std::cos(half(degrees)), 0.0, 0.0, std::sin(half(degrees))};
}

const LimbSegments& limbs(model::Side side) {
    using namespace model::segment;
    static constexpr LimbSegments kRight{kRightShoulder, kRightUpperArm, kRightForeArm, kRightHand,
                                         kRightUpperLeg, kRightLowerLeg, kRightFoot,    kRightToe};
    static constexpr LimbSegments kLeft{kLeftShoulder, kLeftUpperArm, kLeftForeArm, kLeftHand,
                                        kLeftUpperLeg, kLeftLowerLeg, kLeftFoot,    kLeftToe};
    return side == model::Side::Left ? kLeft : kRight;
}

} // namespace posewire::performer
