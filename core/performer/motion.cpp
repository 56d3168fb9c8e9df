// SPDX-License-Identifier: MIT
#include "core/performer/motion.h"

#include "core/performer/curves.h"
#include "core/performer/noise.h"

#include <array>
#include <cmath>
#include <numbers>

namespace posewire::performer {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using model::Side;
using namespace model::segment;

namespace {

constexpr std::array<std::string_view, 5> kNames{"walk", "idle", "wave", "squat", "tpose"};

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Rises, holds and falls once per `period`: 0 … 1 … 0.
double recurring(double seconds, double period, double duration, double ease) {
    const double t = fraction(seconds / period) * period;
    return smoothStep(0.0, ease, t) * (1.0 - smoothStep(duration - ease, duration, t));
}

/// A standing character's place: in a row along y.
Vector3d standingSpot(const MotionSettings& settings) {
    // Wide enough for two neighbours with their arms out.
    constexpr double kSpacing = 2.1;
    return {0.0, kSpacing * (0.5 * (settings.characterCount - 1) - settings.character), 0.0};
}

/// The null pose at any time. A living body sways, here by a fifth of a millimetre: one that does not move at
/// all is a frozen stream.
class TPoseMotion final : public Motion {
public:
    explicit TPoseMotion(const MotionSettings& settings)
        : m_pose(posed(settings.body, settings.body.origins[kPelvis] + standingSpot(settings),
                       LocalRotations())) {}
    BodyPose sample(double seconds) const override {
        constexpr double kSway = 0.0002;
        const double angle = 0.2 * kTurn * seconds;
        BodyPose pose = m_pose;
        for (model::SegmentPose& segment : pose) {
            segment.position += kSway * Vector3d(std::cos(angle), std::sin(angle), 0.0);
        }
        return pose;
    }

private:
    BodyPose m_pose;
};

enum class StandAction : std::uint8_t { Idle, Wave, Squat };

/// Stands on one spot with both feet planted: breathes, sways, shifts weight, looks around; waves or squats
/// now and then, if that is its action.
class StandMotion final : public Motion {
public:
    StandMotion(const MotionSettings& settings, StandAction action);
    BodyPose sample(double seconds) const override;

private:
    /// Everything that changes, at one time. Lengths in metres of the reference body, angles in degrees.
    struct Moment {
        double seconds = 0.0;
        double breath = 0.0; ///< -1 … 1
        double weight = 0.0; ///< -1 right … 1 left
        double look = 0.0;
        double wave = 0.0;  ///< 0 … 1
        double squat = 0.0; ///< 0 … 1
    };
    Moment momentAt(double seconds) const;
    void setUpperBody(const Moment& moment, LocalRotations& rotations) const;
    void addWave(const Moment& moment, LocalRotations& rotations) const;

    model::ReferenceBody m_body;
    StandAction m_action;
    Vector3d m_spot;
    double m_breathHz = 0.25;
    double m_weightHz = 0.09;
    double m_actionStart = 0.0;
    std::array<Wander, 6> m_wander; ///< sway x, sway y (m); look, trunk x, y, arms (degrees)
};

StandMotion::StandMotion(const MotionSettings& settings, StandAction action)
    : m_body(settings.body), m_action(action), m_spot(standingSpot(settings)) {
    const KeyedRandom random =
        KeyedRandom(settings.seed).fork(static_cast<std::uint64_t>(settings.character)).fork(0x7374616eU);
    m_breathHz = random.uniform(0, 0.22, 0.28);
    m_weightHz = random.uniform(1, 0.08, 0.11);
    m_actionStart = random.uniform(2, 0.0, 1.5);
    m_wander = {Wander(random.fork(10), 0.1, 0.4, 0.006), Wander(random.fork(11), 0.1, 0.4, 0.004),
                Wander(random.fork(12), 0.03, 0.25, 8.0), Wander(random.fork(13), 0.06, 0.8, 0.5),
                Wander(random.fork(14), 0.06, 0.8, 0.5),  Wander(random.fork(15), 0.05, 0.5, 1.2)};
}

StandMotion::Moment StandMotion::momentAt(double seconds) const {
    Moment moment;
    moment.seconds = seconds;
    moment.breath = std::sin(kTurn * m_breathHz * seconds);
    // A sine bent to stay longer at its ends: people stand on one leg, then on the other.
    moment.weight = std::tanh(1.8 * std::sin(kTurn * m_weightHz * seconds)) / std::tanh(1.8);
    moment.look = m_wander[2].at(seconds);
    if (m_action == StandAction::Wave) {
        moment.wave = recurring(seconds - m_actionStart, 5.5, 3.6, 0.7);
    } else if (m_action == StandAction::Squat) {
        moment.squat = recurring(seconds - m_actionStart, 3.8, 2.6, 1.15);
    }
    return moment;
}

void StandMotion::setUpperBody(const Moment& moment, LocalRotations& rotations) const {
    const double lean = 35.0 * moment.squat;
    const double side = -4.0 * moment.weight * (1.0 - moment.squat);
    rotations[kPelvis] = aboutX(side) * aboutY(20.0 * moment.squat);
    for (const int index : {kL5, kL3, kT12, kT8}) {
        rotations[index] = aboutX(-0.28 * side) * aboutY(0.25 * lean - 0.1 * 5.0 * moment.squat);
    }
    rotations[kT8] = rotations[kT8] * aboutX(m_wander[3].at(moment.seconds)) *
                     aboutY(m_wander[4].at(moment.seconds) - 1.2 * moment.breath);
    rotations[kNeck] = aboutZ(0.3 * moment.look) * aboutY(1.2 * moment.breath - 0.4 * lean);
    rotations[kHead] = aboutZ(0.7 * moment.look) * aboutY(-0.5 * lean);
    for (const Side armSide : {Side::Right, Side::Left}) {
        const LimbSegments& arm = limbs(armSide);
        const double s = sideSign(armSide);
        const double sway = m_wander[5].at(moment.seconds + (s > 0.0 ? 40.0 : 0.0));
        rotations[arm.shoulder] = aboutX(s * (-5.0 + 1.5 * moment.breath));
        rotations[arm.upperArm] = aboutY(4.0 + sway - 125.0 * moment.squat) * aboutX(-s * 76.0);
        rotations[arm.foreArm] = aboutZ(-s * (14.0 + 0.6 * sway));
        rotations[arm.hand] = aboutX(-4.0 * s);
    }
}

void StandMotion::addWave(const Moment& moment, LocalRotations& rotations) const {
    const LimbSegments& arm = limbs(Side::Right);
    constexpr double kWaveHz = 1.8;
    constexpr double kHandLag = 0.06;
    const double swing = 22.0 * std::sin(kTurn * kWaveHz * moment.seconds);
    const double handSwing = 12.0 * std::sin(kTurn * kWaveHz * (moment.seconds - kHandLag));
    const auto towards = [&](int segment, const Quaterniond& goal) {
        rotations[segment] = rotations[segment].slerp(moment.wave, goal);
    };
    towards(arm.shoulder, aboutX(-8.0));
    // Turned outwards about its own length, so that a bent elbow points the forearm up and the palm forward.
    towards(arm.upperArm, aboutZ(12.0) * aboutX(-8.0) * aboutY(-82.0));
    towards(arm.foreArm, aboutZ(75.0 + swing));
    towards(arm.hand, aboutZ(handSwing));
    rotations[kHead] = rotations[kHead] * aboutZ(-12.0 * moment.wave);
}

BodyPose StandMotion::sample(double seconds) const {
    const Moment moment = momentAt(seconds);
    const double scale = m_body.stature / model::kReferenceStature;
    LocalRotations rotations;
    setUpperBody(moment, rotations);
    if (moment.wave > 0.0) {
        addWave(moment, rotations);
    }
    const double still = 1.0 - moment.squat;
    const double leg = m_body.legLength();
    const Vector3d sway(m_wander[0].at(seconds), m_wander[1].at(seconds) + 0.030 * moment.weight * still,
                        0.0);
    const Vector3d settled(-0.012 - 0.19 * moment.squat, 0.0,
                           -0.007 - 0.44 / 0.8475 * leg / scale * moment.squat);
    BodyPose pose = posed(m_body, m_spot + m_body.origins[kPelvis] + scale * (sway + settled), rotations);
    for (const Side side : {Side::Right, Side::Left}) {
        const LimbSegments& segments = limbs(side);
        constexpr double kToeOut = 7.0;
        const double s = sideSign(side);
        LegGoal goal;
        goal.foot = aboutZ(s * kToeOut);
        goal.ankle = m_spot + m_body.origins[static_cast<std::size_t>(segments.foot)];
        goal.ankle += scale * Vector3d(0.0, 0.015 * s, -0.002);
        goal.upperLegWish = aboutZ(s * (kToeOut + 8.0 * moment.squat)) * aboutY(-70.0 * moment.squat);
        reach(m_body, side, goal, rotations, pose);
    }
    return pose;
}

} // namespace

std::span<const std::string_view> motionNames() {
    return kNames;
}

std::unique_ptr<Motion> makeMotion(std::string_view name, const MotionSettings& settings) {
    if (name == "walk") {
        return makeWalk(settings);
    }
    if (name == "idle") {
        return std::make_unique<StandMotion>(settings, StandAction::Idle);
    }
    if (name == "wave") {
        return std::make_unique<StandMotion>(settings, StandAction::Wave);
    }
    if (name == "squat") {
        return std::make_unique<StandMotion>(settings, StandAction::Squat);
    }
    return name == "tpose" ? std::make_unique<TPoseMotion>(settings) : nullptr;
}

} // namespace posewire::performer
