// SPDX-License-Identifier: MIT
#include "core/performer/body_pose.h"

#include <algorithm>
#include <cmath>

namespace posewire::performer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

double half(double degrees) {
    return 0.5 * degrees * model::kRadiansPerDegree;
}

/// Distance from hip to ankle at a knee flexion in degrees.
double spanAt(double thigh, double shank, double flexion) {
    return std::sqrt(thigh * thigh + shank * shank +
                     2.0 * thigh * shank * std::cos(flexion * model::kRadiansPerDegree));
}

/// Follows `wanted` up to the span at a slightly bent knee, then closes in on that of an almost straight one.
double reachable(double wanted, double thigh, double shank) {
    constexpr double kSoftFlexion = 7.0;
    constexpr double kLeastFlexion = 1.5;
    const double soft = spanAt(thigh, shank, kSoftFlexion);
    const double most = spanAt(thigh, shank, kLeastFlexion);
    if (wanted <= soft) {
        return wanted;
    }
    const double room = most - soft;
    return soft + room * std::tanh((wanted - soft) / room);
}

/// The smallest rotation that turns `from` towards `to`, which are never opposite for a leg.
Quaterniond between(const Vector3d& from, const Vector3d& to) {
    const Vector3d a = from.normalized();
    const Vector3d b = to.normalized();
    const Vector3d axis = a.cross(b);
    return Quaterniond(1.0 + a.dot(b), axis.x(), axis.y(), axis.z()).normalized();
}

double kneeFlexion(double span, double thigh, double shank) {
    const double cosine = (span * span - thigh * thigh - shank * shank) / (2.0 * thigh * shank);
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * model::kDegreesPerRadian;
}

/// In the frame of foot or toe, on the 1.75 m body at sole height.
struct SolePoint {
    bool isOnToe = false;
    std::array<double, 3> position;
};
constexpr std::array<SolePoint, kSolePointCount> kSolePoints{{
    {false, {-0.055, 0.0, -0.078}},
    {false, {0.100, 0.030, -0.078}},
    {false, {0.100, -0.030, -0.078}},
    {false, {0.148, 0.0, -0.078}},
    {true, {0.0, 0.030, -0.013}},
    {true, {0.0, -0.030, -0.013}},
    {true, {0.060, 0.0, -0.013}},
}};

/// Computes the segments `first` to `last` from their parents.
void poseRange(const model::ReferenceBody& body, const LocalRotations& rotations, int first, int last,
               BodyPose& pose) {
    for (int index = first; index <= last; ++index) {
        const auto place = static_cast<std::size_t>(index);
        const auto parent = static_cast<std::size_t>(model::bodySegments()[place].parent);
        pose[place] = model::composed(pose[parent],
                                      {body.origins[place] - body.origins[parent], rotations.values[place]});
    }
}

} // namespace

BodyPose posed(const model::ReferenceBody& body, const Eigen::Vector3d& root,
               const LocalRotations& rotations) {
    BodyPose pose;
    pose[0] = {root, rotations[0]};
    poseRange(body, rotations, 1, model::kBodySegmentCount - 1, pose);
    return pose;
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

void reach(const model::ReferenceBody& body, model::Side side, const LegGoal& goal, LocalRotations& rotations,
           BodyPose& pose) {
    const LimbSegments& leg = limbs(side);
    const double thigh = body.offset(leg.lowerLeg).norm();
    const double shank = body.offset(leg.foot).norm();
    const model::SegmentPose& pelvis = pose[model::segment::kPelvis];
    const Vector3d hip = pelvis.position + pelvis.orientation * body.offset(leg.upperLeg);
    const Vector3d way = goal.ankle - hip;

    const double flexion = kneeFlexion(reachable(way.norm(), thigh, shank), thigh, shank);
    const Quaterniond knee = aboutY(flexion);
    const Vector3d bent =
        goal.upperLegWish * (Vector3d(0.0, 0.0, -thigh) + knee * Vector3d(0.0, 0.0, -shank));
    const Quaterniond upperLeg = between(bent, way) * goal.upperLegWish;

    rotations[leg.upperLeg] = pelvis.orientation.conjugate() * upperLeg;
    rotations[leg.lowerLeg] = knee;
    rotations[leg.foot] = (upperLeg * knee).conjugate() * goal.foot;
    poseRange(body, rotations, leg.upperLeg, leg.toe, pose);
}

std::array<Vector3d, kSolePointCount> worldSolePoints(const model::ReferenceBody& body, model::Side side,
                                                      const BodyPose& pose) {
    const LimbSegments& leg = limbs(side);
    const double scale = body.stature / model::kReferenceStature;
    std::array<Vector3d, kSolePointCount> world;
    for (std::size_t index = 0; index < world.size(); ++index) {
        const SolePoint& point = kSolePoints[index];
        const model::SegmentPose& segment =
            pose[static_cast<std::size_t>(point.isOnToe ? leg.toe : leg.foot)];
        world[index] = segment.position + segment.orientation * (scale * Vector3d(point.position.data()));
    }
    return world;
}

} // namespace posewire::performer
