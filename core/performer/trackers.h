// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/kinematics.h"
#include "core/performer/noise.h"

#include "core/model/body/reference_body.h"

#include <array>
#include <cstdint>
#include <span>

namespace posewire::performer {

inline constexpr int kTrackerCount = 17;

struct TrackerReading {
    int segment = 0;                                                 ///< body segment index
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity(); ///< worldFromTracker
    Eigen::Vector3d freeAcceleration = Eigen::Vector3d::Zero();      ///< world, without gravity
    Eigen::Vector3d acceleration =
        Eigen::Vector3d::Zero(); ///< tracker; what a scale feels, +9.81 upwards at rest
    Eigen::Vector3d angularVelocity = Eigen::Vector3d::Zero(); ///< tracker
    Eigen::Vector3d magneticField = Eigen::Vector3d::Zero();   ///< tracker; length 1 where undisturbed
};

/// The segments around a moment, with what only the motion knows.
struct TrackerMoment {
    ThreeMoments segments;
    std::span<const SegmentState> states; ///< at the middle one
    double seconds = 0.0;
    std::uint64_t frame = 0;                 ///< keys the noise
    std::array<double, 2> sinceHeelStrike{}; ///< right, left, in seconds
};

/// The 17 trackers of a full-body suit, strapped on slightly askew, in the same way for a whole session.
///
/// Noise is of the order of the trackers' class: gyroscope 0.1 °/s white with a slowly wandering bias of 0.2
/// °/s, accelerometer 0.02 m/s², magnetometer 0.003. A heel strike rings at 35 Hz through foot, shank, pelvis
/// and head.
class TrackerSet {
public:
    TrackerSet(const model::ReferenceBody& body, const KeyedRandom& random, const KeyedRandom& session);

    std::array<TrackerReading, kTrackerCount> read(const TrackerMoment& moment) const;

private:
    struct Mount {
        int segment = 0;
        Eigen::Vector3d place;          ///< in the segment, metres
        Eigen::Quaterniond fromTracker; ///< segmentFromTracker
        std::array<Wander, 3> bias;
    };
    TrackerReading readOne(const Mount& mount, std::uint64_t number, const TrackerMoment& moment) const;
    Eigen::Vector3d fieldAt(const Eigen::Vector3d& place) const;

    KeyedRandom m_random;
    Eigen::Vector3d m_field;
    Eigen::Vector3d m_disturbance; ///< where something made of iron lies
    std::array<Mount, kTrackerCount> m_mounts;
};

} // namespace posewire::performer
