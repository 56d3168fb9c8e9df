// SPDX-License-Identifier: MIT
#pragma once

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

/// Walking speed and stride time that belong to the curves.
inline constexpr double kFreeSpeed = 1.33;      ///< m/s
inline constexpr double kFreeStrideTime = 1.08; ///< s

/// Mean walking at free speed; `phase` 0 and 1 are heel strikes of the leg. Any phase is taken modulo 1.
///
/// Curves: Schwartz, Rozumalski and Trost, J Biomech 2008;41:1639–1650, as eight harmonics fitted to the
/// means at every 2 % of the cycle; the largest error is 0.6° (ankle at push-off), 0.3° at the knee, 0.25°
/// elsewhere.
GaitAngles gaitAngles(double phase);

} // namespace posewire::performer
