// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/motion.h"
#include "core/performer/noise.h"
#include "core/performer/path.h"
#include "core/performer/walk_clip.h"

namespace posewire::performer {

/// Walks a figure of eight at even speed. Up to four characters share one eight, spread over the lap so
/// that they pass the crossing one after the other; further groups walk eights of their own beside it.
///
/// The straight clip is bent along the path: whatever rests on the floor there rests on it here. The legs are
/// then solved for the bent places of the feet.
class WalkMotion final : public Motion {
public:
    explicit WalkMotion(const MotionSettings& settings);

    BodyPose sample(double seconds) const override;
    double sinceHeelStrike(model::Side side, double seconds) const override;

    double strideTime() const { return m_strideTime; }

private:
    double phaseAt(double seconds) const;
    void addLife(double seconds, const PathPlace& place, double distance, LocalRotations& rotations) const;
    /// The straight walk at one time.
    struct Stride {
        double phase = 0.0;
        double distance = 0.0; ///< along the path, of the straight walk's origin
        double heading = 0.0;  ///< of the path at the pelvis
        BodyPose pose;
    };
    void plant(model::Side side, const Stride& straight, LocalRotations& rotations, BodyPose& pose) const;

    model::ReferenceBody m_body;
    FigureOfEight m_path;
    WalkClip m_clip;
    double m_startDistance = 0.0;
    double m_startPhase = 0.0;
    double m_strideTime = 1.0;
    std::array<Wander, 6> m_wander; ///< trunk x y z, head x y z, in degrees
};

} // namespace posewire::performer
