// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/body_pose.h"
#include "core/performer/gait.h"
#include "core/performer/periodic_spline.h"

#include <array>

namespace posewire::performer {

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
    Eigen::Vector3d footCorrection(model::Side side, double phase) const;

    /// The phase of that side's own cycle, 0 at its heel strike.
    static double sidePhase(model::Side side, double phase);

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

} // namespace posewire::performer
