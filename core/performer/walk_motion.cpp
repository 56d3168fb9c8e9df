// SPDX-License-Identifier: MIT
#include "core/performer/motion.h"
#include "core/performer/noise.h"
#include "core/performer/walk_clip.h"

#include <algorithm>
#include <cmath>

namespace posewire::performer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;
using model::Side;
using namespace model::segment;

/// All walk at the same speed, so that they never catch up with each other; stature shows in the cadence.
constexpr double kSpeed = 1.22; // m/s
constexpr double kHalfWidth = 3.8;
constexpr int kPerGroup = 4;
constexpr double kGroupSpacing = 5.0;

enum WalkKey : std::uint64_t {
    kAmplitude,
    kArmSwing,
    kArmAbduction,
    kLimpSide,
    kLimp,
    kPhase,
    kToeOut,
    kWanderFirst = 100
};

WalkStyle styleFor(const KeyedRandom& random) {
    WalkStyle style;
    style.amplitude = std::sqrt(kSpeed / kFreeSpeed) * random.uniform(kAmplitude, 0.96, 1.04);
    style.armSwing = random.uniform(kArmSwing, 0.9, 1.25);
    style.armAbduction = random.uniform(kArmAbduction, 72.0, 79.0);
    style.toeOut = random.uniform(kToeOut, 3.0, 7.0);
    style.stepFactor[random.uniform(kLimpSide) < 0.5 ? 0 : 1] = random.uniform(kLimp, 0.98, 1.0);
    return style;
}

KeyedRandom walkRandom(const MotionSettings& settings) {
    return KeyedRandom(settings.seed).fork(static_cast<std::uint64_t>(settings.character)).fork(0x77616c6bU);
}

FigureOfEight pathFor(const MotionSettings& settings) {
    const int group = settings.character / kPerGroup;
    return FigureOfEight(kHalfWidth, Vector2d(0.0, kGroupSpacing * group));
}

double startShareFor(const MotionSettings& settings) {
    const int group = settings.character / kPerGroup;
    const int groupSize = std::clamp(settings.characterCount - kPerGroup * group, 1, kPerGroup);
    const int place = settings.character % kPerGroup;
    // Every other character starts in the other lobe, so that no two pass the crossing at once.
    return 0.5 * place / groupSize + (place % 2 == 1 ? 0.5 : 0.0);
}

/// A place of the straight walk (x along the path from its start, y to its left), bent along the path.
Vector3d bent(const PathPlace& place, double y, double z) {
    const Vector2d left(-std::sin(place.heading), std::cos(place.heading));
    const Vector2d floor = place.position + y * left;
    return {floor.x(), floor.y(), z};
}

Quaterniond turned(double heading) {
    return aboutZ(heading * model::kDegreesPerRadian);
}

/// Half of what would balance the turn, in degrees, inwards.
double leanFor(const PathPlace& place) {
    return 0.5 * std::atan(kSpeed * kSpeed * place.curvature / model::kGravity) * model::kDegreesPerRadian;
}

/// Walks a figure of eight at even speed. Up to four characters share one eight, spread over the lap so
/// that they pass the crossing one after the other; further groups walk eights of their own beside it.
///
/// The straight clip is bent along the path: whatever rests on the floor there rests on it here. The legs are
/// then solved for the bent places of the feet.
class WalkMotion final : public Motion {
public:
    explicit WalkMotion(const MotionSettings& settings);

    BodyPose sample(double seconds) const override;
    double sinceHeelStrike(Side side, double seconds) const override {
        return WalkClip::sidePhase(side, phaseAt(seconds)) * m_strideTime;
    }

private:
    double phaseAt(double seconds) const { return m_startPhase + seconds / m_strideTime; }
    void addLife(double seconds, const PathPlace& place, double distance, LocalRotations& rotations) const;
    /// The straight walk at one time.
    struct Stride {
        double phase = 0.0;
        double distance = 0.0; ///< along the path, of the straight walk's origin
        double heading = 0.0;  ///< of the path at the pelvis
        BodyPose pose;
    };
    void plant(Side side, const Stride& straight, LocalRotations& rotations, BodyPose& pose) const;

    model::ReferenceBody m_body;
    FigureOfEight m_path;
    WalkClip m_clip;
    double m_startDistance = 0.0;
    double m_startPhase = 0.0;
    double m_strideTime = 1.0;
    std::array<Wander, 6> m_wander; ///< trunk x y z, head x y z, in degrees
};

WalkMotion::WalkMotion(const MotionSettings& settings)
    : m_body(settings.body),
      m_path(pathFor(settings)),
      m_clip(settings.body, styleFor(walkRandom(settings))) {
    const KeyedRandom random = walkRandom(settings);
    // All start a little after the crossing, the first on the way to the near lobe.
    m_startDistance = m_path.length() * (startShareFor(settings) + 0.04);
    m_startPhase = random.uniform(kPhase);
    m_strideTime = m_clip.strideLength() / kSpeed;
    for (std::size_t index = 0; index < m_wander.size(); ++index) {
        const bool isHead = index >= 3;
        m_wander[index] = Wander(random.fork(kWanderFirst + index), 0.06, 0.9, isHead ? 1.2 : 0.5);
    }
}

void WalkMotion::addLife(double seconds, const PathPlace& place, double distance,
                         LocalRotations& rotations) const {
    // The head looks where the body will be 0.4 s later.
    constexpr double kMostLead = 18.0;
    const double ahead = m_path.at(distance + 0.4 * kSpeed).heading - place.heading;
    const double turn = std::remainder(ahead, 2.0 * std::numbers::pi) * model::kDegreesPerRadian;
    const double lead = kMostLead * std::tanh(turn / kMostLead);
    const double lean = leanFor(place);
    rotations[kNeck] = aboutZ(0.4 * lead) * aboutX(0.3 * lean) * rotations[kNeck];
    rotations[kHead] = aboutZ(0.6 * lead + m_wander[5].at(seconds)) *
                       aboutX(0.3 * lean + m_wander[3].at(seconds)) * aboutY(m_wander[4].at(seconds)) *
                       rotations[kHead];
    for (const int index : {kL3, kT8}) {
        rotations[index] = rotations[index] * aboutZ(m_wander[2].at(seconds)) *
                           aboutX(m_wander[0].at(seconds)) * aboutY(m_wander[1].at(seconds));
    }
}

void WalkMotion::plant(Side side, const Stride& straight, LocalRotations& rotations, BodyPose& pose) const {
    const LimbSegments& leg = limbs(side);
    const auto at = [&](int segment) -> const model::SegmentPose& {
        return straight.pose[static_cast<std::size_t>(segment)];
    };
    const Vector3d ball = at(leg.toe).position + m_clip.footCorrection(side, straight.phase);
    // The foot turns with the path at the ball, about which it also rolls off: so the ball stays where it is.
    const PathPlace place = m_path.at(straight.distance + ball.x());
    LegGoal goal;
    goal.foot = turned(place.heading) * at(leg.foot).orientation;
    goal.ankle = bent(place, ball.y(), ball.z()) - goal.foot * m_body.offset(leg.toe);
    goal.upperLegWish = turned(straight.heading) * at(leg.upperLeg).orientation;
    reach(m_body, side, goal, rotations, pose);
}

BodyPose WalkMotion::sample(double seconds) const {
    Stride straight;
    straight.phase = phaseAt(seconds);
    straight.distance = m_startDistance + kSpeed * seconds;
    LocalRotations rotations = m_clip.rotations(straight.phase);
    const Vector3d root = m_clip.root(straight.phase);
    straight.pose = posed(m_body, root, rotations);

    const double distance = straight.distance + root.x();
    const PathPlace place = m_path.at(distance);
    straight.heading = place.heading;
    const double lean = leanFor(place);
    addLife(seconds, place, distance, rotations);
    rotations[kPelvis] = turned(place.heading) * aboutX(-0.25 * lean) * rotations[kPelvis];
    const double inward = 0.4 * lean * model::kRadiansPerDegree * root.z();
    // A little lower than the curves say: bent along the path, the outer leg has to reach farther.
    const double drop = 0.002 + 10.0 * inward * inward;
    BodyPose pose = posed(m_body, bent(place, root.y() + inward, root.z() - drop), rotations);
    for (const Side side : {Side::Right, Side::Left}) {
        plant(side, straight, rotations, pose);
    }
    return pose;
}

} // namespace

std::unique_ptr<Motion> makeWalk(const MotionSettings& settings) {
    return std::make_unique<WalkMotion>(settings);
}

} // namespace posewire::performer
