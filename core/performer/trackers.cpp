// SPDX-License-Identifier: MIT
#include "core/performer/trackers.h"

#include <cmath>
#include <numbers>

namespace posewire::performer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using namespace model::segment;

/// How a tracker lies on its segment: x along the bone, z out of the skin.
enum class Lie { Back, Chest, Top, ThighSide, ShinFront, FootTop };

struct MountPlan {
    int segment;
    std::array<double, 3> place; ///< on the 1.75 m body
    Lie lie;
};

constexpr std::array<MountPlan, kTrackerCount> kPlans{{
    {kPelvis, {-0.10, 0.0, 0.06}, Lie::Back},
    {kT8, {0.13, 0.0, 0.06}, Lie::Chest},
    {kHead, {-0.10, 0.0, 0.07}, Lie::Back},
    {kRightShoulder, {-0.03, -0.09, 0.05}, Lie::Top},
    {kRightUpperArm, {-0.01, -0.16, 0.045}, Lie::Top},
    {kRightForeArm, {-0.005, -0.20, 0.025}, Lie::Top},
    {kRightHand, {0.0, -0.05, 0.02}, Lie::Top},
    {kLeftShoulder, {-0.03, 0.09, 0.05}, Lie::Top},
    {kLeftUpperArm, {-0.01, 0.16, 0.045}, Lie::Top},
    {kLeftForeArm, {-0.005, 0.20, 0.025}, Lie::Top},
    {kLeftHand, {0.0, 0.05, 0.02}, Lie::Top},
    {kRightUpperLeg, {0.0, -0.07, -0.22}, Lie::ThighSide},
    {kRightLowerLeg, {0.03, 0.0, -0.10}, Lie::ShinFront},
    {kRightFoot, {0.06, 0.0, -0.02}, Lie::FootTop},
    {kLeftUpperLeg, {0.0, 0.07, -0.22}, Lie::ThighSide},
    {kLeftLowerLeg, {0.03, 0.0, -0.10}, Lie::ShinFront},
    {kLeftFoot, {0.06, 0.0, -0.02}, Lie::FootTop},
}};

Quaterniond fromAxes(const Vector3d& alongBone, const Vector3d& outOfSkin) {
    Eigen::Matrix3d axes;
    axes << alongBone, outOfSkin.cross(alongBone), outOfSkin;
    return Quaterniond(axes);
}

Quaterniond lieOf(const MountPlan& plan) {
    const double side = plan.place[1] < 0.0 ? -1.0 : 1.0;
    switch (plan.lie) {
    case Lie::Back:
        return fromAxes(Vector3d::UnitZ(), -Vector3d::UnitX());
    case Lie::Chest:
        return fromAxes(Vector3d::UnitZ(), Vector3d::UnitX());
    case Lie::Top:
        return fromAxes(side * Vector3d::UnitY(), Vector3d::UnitZ());
    case Lie::ThighSide:
        return fromAxes(-Vector3d::UnitZ(), side * Vector3d::UnitY());
    case Lie::ShinFront:
        return fromAxes(-Vector3d::UnitZ(), Vector3d::UnitX());
    case Lie::FootTop:
        break;
    }
    return fromAxes(Vector3d::UnitX(), Vector3d::UnitZ());
}

/// m/s² that a heel strike shakes a segment with, at first.
double shakeOf(int segment) {
    switch (segment) {
    case kRightFoot:
    case kLeftFoot:
        return 15.0;
    case kRightLowerLeg:
    case kLeftLowerLeg:
        return 8.0;
    case kPelvis:
        return 3.0;
    case kHead:
        return 1.0;
    default:
        return 0.0;
    }
}

double shakeAt(int segment, const std::array<double, 2>& sinceHeelStrike) {
    constexpr double kHertz = 35.0;
    constexpr double kDecay = 0.025;
    constexpr double kOver = 0.4;
    const model::Side side = model::bodySegments()[static_cast<std::size_t>(segment)].side;
    double shake = 0.0;
    for (std::size_t foot = 0; foot < 2; ++foot) {
        const model::Side footSide = foot == 0 ? model::Side::Right : model::Side::Left;
        const double since = sinceHeelStrike[foot];
        if ((side == model::Side::Centre || side == footSide) && since < kOver) {
            shake += std::exp(-since / kDecay) * std::sin(2.0 * std::numbers::pi * kHertz * since);
        }
    }
    return shakeOf(segment) * shake;
}

} // namespace

TrackerSet::TrackerSet(const model::ReferenceBody& body, const KeyedRandom& random,
                       const KeyedRandom& session)
    : m_random(random.fork(0x6e6f6973U)) {
    constexpr double kCrookedDegrees = 6.0;
    constexpr double kBiasDegrees = 0.2;
    const double scale = body.stature / model::kReferenceStature;
    for (std::size_t index = 0; index < m_mounts.size(); ++index) {
        const KeyedRandom own = random.fork(index);
        const Vector3d crooked = (kCrookedDegrees * own.normal3(1)).cwiseMin(10.0).cwiseMax(-10.0);
        Mount& mount = m_mounts[index];
        const MountPlan& plan = kPlans[index];
        mount.segment = plan.segment;
        mount.place = scale * Vector3d(plan.place.data());
        mount.fromTracker = lieOf(plan) * aboutX(crooked.x()) * aboutY(crooked.y()) * aboutZ(crooked.z());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            mount.bias[axis] =
                Wander(own.fork(10 + axis), 0.002, 0.05, kBiasDegrees * model::kRadiansPerDegree);
        }
    }
    // Steeply down, as in the middle of Europe; where north lies is the session's luck.
    m_field = aboutZ(session.uniform(1, 0.0, 360.0)) * Vector3d(0.36, 0.0, -0.93).normalized();
    m_disturbance = Vector3d(session.uniform(2, 1.0, 2.5), session.uniform(3, 0.2, 1.2), 0.1);
}

Vector3d TrackerSet::fieldAt(const Vector3d& place) const {
    constexpr double kReach = 0.7;
    constexpr double kMost = 0.25;
    const Vector3d way = place - m_disturbance;
    const double share = kMost * std::exp(-way.squaredNorm() / (kReach * kReach));
    // Partly along the field, partly towards the iron: both length and direction change.
    return m_field * (1.0 + 0.7 * share) - 0.7 * share * way / (way.norm() + 0.1);
}

std::array<TrackerReading, kTrackerCount> TrackerSet::read(const TrackerMoment& moment) const {
    std::array<TrackerReading, kTrackerCount> readings;
    for (std::size_t index = 0; index < readings.size(); ++index) {
        readings[index] = readOne(m_mounts[index], moment.frame * kTrackerCount + index, moment);
    }
    return readings;
}

TrackerReading TrackerSet::readOne(const Mount& mount, std::uint64_t number,
                                   const TrackerMoment& moment) const {
    constexpr double kAccelerationNoise = 0.02;
    constexpr double kGyroNoise = 0.1 * model::kRadiansPerDegree;
    constexpr double kFieldNoise = 0.003;
    const auto index = static_cast<std::size_t>(mount.segment);
    const auto placeIn = [&](const model::SegmentPose& segment) -> Vector3d {
        return segment.position + segment.orientation * mount.place;
    };
    const Vector3d place = placeIn(moment.segments.now[index]);
    const PointState point = differentiated(placeIn(moment.segments.before[index]), place,
                                            placeIn(moment.segments.after[index]), moment.segments.step);
    const double shake = shakeAt(mount.segment, moment.sinceHeelStrike);
    const Vector3d felt = kAccelerationNoise * m_random.normal3(3 * number);
    const Vector3d bias(mount.bias[0].at(moment.seconds), mount.bias[1].at(moment.seconds),
                        mount.bias[2].at(moment.seconds));

    TrackerReading reading;
    reading.segment = mount.segment;
    reading.orientation = (moment.segments.now[index].orientation * mount.fromTracker).normalized();
    const Quaterniond trackerFromWorld = reading.orientation.conjugate();
    reading.freeAcceleration = point.acceleration + Vector3d(0.0, 0.0, shake) + reading.orientation * felt;
    reading.acceleration =
        trackerFromWorld * (reading.freeAcceleration + Vector3d(0.0, 0.0, model::kGravity));
    reading.angularVelocity = trackerFromWorld * moment.states[index].angularVelocity + bias +
                              kGyroNoise * m_random.normal3(3 * number + 1);
    reading.magneticField =
        trackerFromWorld * fieldAt(place) + kFieldNoise * m_random.normal3(3 * number + 2);
    return reading;
}

} // namespace posewire::performer
