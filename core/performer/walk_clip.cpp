// SPDX-License-Identifier: MIT
#include "core/performer/walk_clip.h"

#include "core/performer/easing.h"
#include "core/performer/walk_planting.h"

#include <cmath>
#include <numbers>

namespace posewire::performer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using model::Side;
using namespace model::segment;

constexpr std::size_t kSamples = 256;
constexpr double kMeanHipFlexion = 18.442;

/// How much the foot is lifted off behind: the toes stay flat while it is.
double pushOff(double phase) {
    return smoothStep(0.30, 0.42, phase) * (1.0 - smoothStep(0.62, 0.74, phase));
}

/// More knee and ankle in the swing: the mean curves would scuff the toe of this body.
double clearing(double phase) {
    return smoothStep(0.62, 0.74, phase) * (1.0 - smoothStep(0.78, 0.92, phase));
}

/// A knee that is not quite stretched at heel strike leaves room for longer steps on the outside of a turn.
double softStrike(double phase) {
    return phase > 0.5 ? smoothStep(0.78, 0.92, phase) : 1.0 - smoothStep(0.02, 0.12, phase);
}

void setTrunk(const GaitAngles& gait, LocalRotations& rotations) {
    const double tilt = gait.pelvisTilt - kMeanPelvisTilt;
    rotations[kPelvis] = aboutZ(gait.pelvisRotation) * aboutX(-gait.pelvisObliquity) * aboutY(tilt);
    // The spine takes back the pelvis's turn and more, so that shoulders and arms swing against the legs.
    constexpr double kShare = 0.25;
    for (const int index : {kL5, kL3, kT12, kT8}) {
        rotations[index] = aboutZ(-1.7 * kShare * gait.pelvisRotation) *
                           aboutX(1.1 * kShare * gait.pelvisObliquity) * aboutY(kShare * (3.0 - 0.8 * tilt));
    }
    rotations[kNeck] = aboutZ(0.35 * gait.pelvisRotation);
    rotations[kHead] = aboutZ(0.35 * gait.pelvisRotation) * aboutY(-2.0);
}

} // namespace

WalkClip::WalkClip(const model::ReferenceBody& body, const WalkStyle& style) : m_body(body), m_style(style) {
    std::vector<SoleFrame> soles(kSamples);
    for (std::size_t sample = 0; sample < kSamples; ++sample) {
        const double phase = static_cast<double>(sample) / static_cast<double>(kSamples);
        const BodyPose pose = posed(m_body, Vector3d::Zero(), rotations(phase));
        soles[sample] = {worldSolePoints(m_body, Side::Right, pose),
                         worldSolePoints(m_body, Side::Left, pose)};
    }
    PelvisPath path = pelvisPath(soles);
    m_strideLength = path.strideLength;
    for (const Side side : {Side::Right, Side::Left}) {
        m_footCorrections[side == Side::Right ? 0 : 1] =
            PeriodicSpline<Vector3d>(footCorrections(soles, path, side));
    }
    m_root = PeriodicSpline<Vector3d>(std::move(path.roots));
}

double WalkClip::sidePhase(Side side, double phase) {
    return fraction(side == Side::Left ? phase + 0.5 : phase);
}

Vector3d WalkClip::footCorrection(Side side, double phase) const {
    return m_footCorrections[side == Side::Right ? 0 : 1].at(phase);
}

LocalRotations WalkClip::rotations(double phase) const {
    LocalRotations rotations;
    const GaitAngles right = gaitAngles(phase);
    setTrunk(right, rotations);
    for (const Side side : {Side::Right, Side::Left}) {
        const double own = sidePhase(side, phase);
        setLeg(side, side == Side::Right ? right : gaitAngles(own), own, rotations);
        setArm(side, own, rotations);
        setToe(side, own, rotations);
    }
    return rotations;
}

void WalkClip::setLeg(Side side, const GaitAngles& gait, double phase, LocalRotations& rotations) const {
    const LimbSegments& leg = limbs(side);
    const double s = sideSign(side);
    const double clear = clearing(phase);
    const double amplitude = m_style.amplitude;
    const double hipFactor = amplitude * m_style.stepFactor[side == Side::Right ? 0 : 1];
    const double hip = kMeanHipFlexion - kMeanPelvisTilt + hipFactor * (gait.hipFlexion - kMeanHipFlexion);
    const double knee = amplitude * gait.kneeFlexion + 6.0 * clear + 2.0 * softStrike(phase);
    const double ankle = amplitude * gait.ankleDorsiflexion + 5.0 * clear;
    // The published hip rotation is noisy between laboratories; a part of it is enough.
    constexpr double kHipRotationShare = 0.6;
    rotations[leg.upperLeg] =
        aboutY(-hip) * aboutX(-s * gait.hipAdduction) * aboutZ(-s * kHipRotationShare * gait.hipRotation);
    rotations[leg.lowerLeg] = aboutY(knee);
    rotations[leg.foot] = aboutZ(s * m_style.toeOut) * aboutY(-ankle);
}

void WalkClip::setArm(Side side, double phase, LocalRotations& rotations) const {
    const LimbSegments& arm = limbs(side);
    const double s = sideSign(side);
    // Behind at the own heel strike, in front at the other one.
    const double swing = m_style.armSwing * std::cos(2.0 * std::numbers::pi * phase);
    rotations[arm.shoulder] = aboutX(-5.0 * s);
    rotations[arm.upperArm] = aboutY(18.0 * swing + 4.0) * aboutX(-s * m_style.armAbduction);
    rotations[arm.foreArm] = aboutZ(-s * (24.0 - 9.0 * swing));
    rotations[arm.hand] = aboutX(-4.0 * s);
}

void WalkClip::setToe(Side side, double phase, LocalRotations& rotations) const {
    const LimbSegments& leg = limbs(side);
    const Quaterniond foot =
        rotations[kPelvis] * rotations[leg.upperLeg] * rotations[leg.lowerLeg] * rotations[leg.foot];
    const Vector3d forward = foot * Vector3d::UnitX();
    const double down =
        std::atan2(-forward.z(), std::hypot(forward.x(), forward.y())) * model::kDegreesPerRadian;
    rotations[leg.toe] = aboutY(-0.85 * pushOff(phase) * smoothPositive(down, 3.0));
}

} // namespace posewire::performer
