// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/motion.h"
#include "core/performer/noise.h"

namespace posewire::performer {

/// The exact null pose at any time.
class TPoseMotion final : public Motion {
public:
    explicit TPoseMotion(const MotionSettings& settings);
    BodyPose sample(double seconds) const override;

private:
    BodyPose m_pose;
};

/// What a standing character does.
enum class StandAction : std::uint8_t { Idle, Wave, Squat };

/// Stands on one spot with both feet planted: breathes, sways, shifts weight, looks around; waves or squats
/// now and then, if that is its action.
class StandMotion final : public Motion {
public:
    StandMotion(const MotionSettings& settings, StandAction action);
    BodyPose sample(double seconds) const override;

private:
    struct Moment;
    Moment momentAt(double seconds) const;
    void setUpperBody(const Moment& moment, LocalRotations& rotations) const;
    void addWave(const Moment& moment, LocalRotations& rotations) const;

    model::ReferenceBody m_body;
    StandAction m_action;
    Eigen::Vector3d m_spot;
    double m_breathHz = 0.25;
    double m_weightHz = 0.09;
    double m_actionStart = 0.0;
    std::array<Wander, 6> m_wander; ///< sway x, sway y (m); look, trunk x, y, arms (degrees)
};

/// A standing character's place: in a row along y.
Eigen::Vector3d standingSpot(const MotionSettings& settings);

} // namespace posewire::performer
