// SPDX-License-Identifier: MIT
#include "core/performer/kinematics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace posewire::performer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Mass {
    double share;  ///< as tabulated; head, trunk and limbs together make 1.0 but for rounding
    double centre; ///< share of the way to the second point of the segment, the joint that it reaches to; the
                   ///< rib cage reaches far below the joint at which T8 begins
};

constexpr std::array<Mass, model::kBodySegmentCount> kMasses{{
    {0.142, 0.5},                                                    // pelvis
    {0.046, 0.5},   {0.046, 0.5},    {0.047, 0.5},                   // L5, L3, T12
    {0.160, -0.3},  {0.020, 0.5},    {0.061, 0.5},                   // T8, neck, head
    {0.028, 0.5},   {0.028, 0.436},  {0.016, 0.430}, {0.006, 0.506}, // right arm
    {0.028, 0.5},   {0.028, 0.436},  {0.016, 0.430}, {0.006, 0.506}, // left arm
    {0.100, 0.433}, {0.0465, 0.433}, {0.0115, 0.5},  {0.003, 0.5},   // right leg
    {0.100, 0.433}, {0.0465, 0.433}, {0.0115, 0.5},  {0.003, 0.5},   // left leg
}};

constexpr double kTabulatedSum = std::accumulate(
    kMasses.begin(), kMasses.end(), 0.0, [](double sum, const Mass& mass) { return sum + mass.share; });

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

PointState differentiated(const Vector3d& before, const Vector3d& now, const Vector3d& after, double step) {
    return {now, (after - before) / (2.0 * step), (after - 2.0 * now + before) / (step * step)};
}

Vector3d rotationBetween(const Quaterniond& from, const Quaterniond& to) {
    Quaterniond way = to * from.conjugate();
    if (way.w() < 0.0) {
        way.coeffs() = -way.coeffs();
    }
    const double sine = way.vec().norm();
    constexpr double kTiny = 1e-12;
    if (sine < kTiny) {
        return 2.0 * way.vec();
    }
    return way.vec() * (2.0 * std::atan2(sine, way.w()) / sine);
}

void differentiate(const ThreeMoments& moments, std::span<SegmentState> states) {
    const auto& [before, now, after, step] = moments;
    for (std::size_t index = 0; index < now.size(); ++index) {
        const PointState point =
            differentiated(before[index].position, now[index].position, after[index].position, step);
        const Vector3d first = rotationBetween(before[index].orientation, now[index].orientation) / step;
        const Vector3d second = rotationBetween(now[index].orientation, after[index].orientation) / step;
        states[index] = {now[index], point.velocity, point.acceleration, 0.5 * (first + second),
                         (second - first) / step};
    }
}

Vector3d centreOfMass(const model::ReferenceBody& body, std::span<const model::SegmentPose> segments) {
    static const auto first = [] { // place of the first point of each segment in the table of points
        std::array<std::size_t, model::kBodySegmentCount> places{};
        const auto points = model::anatomicalPoints();
        for (std::size_t place = points.size(); place-- > 0;) {
            places[static_cast<std::size_t>(points[place].segment)] = place;
        }
        return places;
    }();
    Vector3d sum = Vector3d::Zero();
    for (std::size_t index = 0; index < kMasses.size(); ++index) {
        const Mass& mass = kMasses[index];
        const Vector3d& far = body.points[first[index] + 1];
        sum += mass.share * (segments[index].position + segments[index].orientation * (mass.centre * far));
    }
    return sum / kTabulatedSum;
}

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
