// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/curves.h"
#include "core/performer/kinematics.h"

#include <array>
#include <vector>

namespace posewire::performer {

/// Angles of one leg and the pelvis at a moment of the gait cycle of that leg, in degrees.
struct GaitAngles {
    double pelvisTilt = 0.0;        ///< anterior +
    double pelvisObliquity = 0.0;   ///< own side up +
    double pelvisRotation = 0.0;    ///< own side forward +
    double hipFlexion = 0.0;        ///< flexion +, against the tilted pelvis
    double hipAdduction = 0.0;      ///< adduction +
    double hipRotation = 0.0;       ///< internal +
    double kneeFlexion = 0.0;       ///< flexion +
    double ankleDorsiflexion = 0.0; ///< dorsiflexion +
};

/// Mean pelvis tilt over a cycle, and so the hip flexion of a person standing upright.
inline constexpr double kMeanPelvisTilt = 11.588;

/// Walking speed that belongs to the curves, in m/s; the stride takes 1.08 s.
inline constexpr double kFreeSpeed = 1.33;

/// Mean walking at free speed; `phase` 0 and 1 are heel strikes of the leg. Any phase is taken modulo 1.
///
/// Curves: Schwartz, Rozumalski and Trost, J Biomech 2008;41:1639–1650, as eight harmonics fitted to the
/// means at every 2 % of the cycle; the largest error is 0.6° (ankle at push-off), 0.3° at the knee, 0.25°
/// elsewhere.
GaitAngles gaitAngles(double phase);

/// A personal way of walking: factors and angles on top of the mean.
struct WalkStyle {
    double amplitude = 1.0;                     ///< of all leg angles about their means
    double armSwing = 1.0;                      ///< of the swing of the arms
    double armAbduction = 76.0;                 ///< degrees down from the T-pose
    double toeOut = 4.0;                        ///< degrees
    std::array<double, 2> stepFactor{1.0, 1.0}; ///< of the hip flexion, right and left: a slight limp
};

/// One cycle of straight walking along x on a level floor, for one body. Phase 0 is the strike of the right
/// heel, phase 0.5 that of the left.
///
/// The joint angles come from the gait curves; the feet that carry the pelvis determine where it is. What
/// then remains of slipping, sinking and floating is measured once, at construction, and given as a
/// correction for each foot.
class WalkClip {
public:
    WalkClip(const model::ReferenceBody& body, const WalkStyle& style);

    /// Metres from one right heel strike to the next.
    double strideLength() const { return m_strideLength; }

    LocalRotations rotations(double phase) const;

    /// The pelvis against a point on the floor that moves evenly along x at strideLength() per cycle.
    Eigen::Vector3d root(double phase) const { return m_root.at(phase); }

    /// Added to the foot's position from rotations() and root(), it keeps the foot still on the floor while
    /// it bears weight and clear of it while it swings. `phase` is that of the clip.
    Eigen::Vector3d footCorrection(model::Side side, double phase) const {
        return m_footCorrections[side == model::Side::Right ? 0 : 1].at(phase);
    }

    /// The phase of that side's own cycle, 0 at its heel strike.
    static double sidePhase(model::Side side, double phase) {
        return fraction(side == model::Side::Left ? phase + 0.5 : phase);
    }

private:
    void setLeg(model::Side side, const GaitAngles& gait, double phase, LocalRotations& rotations) const;
    void setArm(model::Side side, double phase, LocalRotations& rotations) const;
    void setToe(model::Side side, double phase, LocalRotations& rotations) const;

    model::ReferenceBody m_body;
    WalkStyle m_style;
    double m_strideLength = 0.0;
    PeriodicSpline<Eigen::Vector3d> m_root;
    std::array<PeriodicSpline<Eigen::Vector3d>, 2> m_footCorrections; ///< right, left; by the clip's phase
};

/// The sole points of both feet (right, left) at equally spaced phases of one cycle, relative to the pelvis
/// origin.
using SoleFrame = std::array<std::array<Eigen::Vector3d, kSolePointCount>, 2>;

struct PelvisPath {
    std::vector<Eigen::Vector3d> roots; ///< against an evenly moving point, one for each frame of the soles
    double strideLength = 0.0;          ///< metres
};

/// From the feet: the height of the pelvis puts the lowest point of the feet that carry it on the floor, its
/// velocity is the opposite of the mean velocity of the points that touch it. Both are smoothed by about
/// 40 ms. Takes at least 32 frames.
PelvisPath pelvisPath(const std::vector<SoleFrame>& soles);

/// What keeps a foot from slipping, sinking and floating while the pelvis moves along `path`; one for each
/// frame of the soles.
std::vector<Eigen::Vector3d> footCorrections(const std::vector<SoleFrame>& soles, const PelvisPath& path,
                                             model::Side side);

} // namespace posewire::performer
