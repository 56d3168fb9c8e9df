// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/kinematics.h"
#include "core/performer/motion.h"
#include "core/performer/trackers.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::performer {

/// Appends the props and fingers that follow the body in a pose datagram to `poses`, which hold the body
/// alone. `curl` from 0 (flat hand) to 1 (fist).
void appendExtraSegments(const model::SegmentLayout& layout, const model::ReferenceBody& body, double curl,
                         std::vector<model::SegmentPose>& poses);

/// "Sword", "Crutch", "Generic" and "Golfclub", as a sender names its props.
std::string_view propName(int prop);

/// A character's identity, as sent in type 12.
struct Identity {
    std::string name;
    std::string colour; ///< RRGGBB
    std::string suitId; ///< the tag "xmid"
    double stature = 1.75;
};

/// Distinct for the first eight.
Identity identityOf(int character);

struct CharacterSettings {
    int id = 0;    ///< on the wire
    int count = 1; ///< of characters that share the floor
    std::uint64_t seed = 1;
    std::string motion;
    model::SegmentLayout layout;
};

struct CharacterMoment {
    std::vector<SegmentState> segments; ///< body, props, fingers, as in the layout
    PointState centreOfMass;
    std::array<TrackerReading, kTrackerCount> trackers;
};

/// A body with its motion, sampled at a fixed rate.
class Character {
public:
    /// The motion's name must be known.
    Character(const CharacterSettings& settings, double rateHz);

    /// The moment of a frame. The result is valid until the next call; frames in order share their samples.
    const CharacterMoment& at(std::uint64_t frame);

    int id() const { return m_settings.id; }
    const Identity& identity() const { return m_identity; }
    const model::ReferenceBody& body() const { return m_body; }
    const model::SegmentLayout& layout() const { return m_settings.layout; }
    const Motion& motion() const { return *m_motion; }
    /// Origins of all segments in the null pose, ball of the foot at z = 0.
    std::vector<Eigen::Vector3d> nullPose() const;

private:
    using Poses = std::vector<model::SegmentPose>;
    struct Sample {
        std::int64_t key = -1;
        Poses poses; ///< none at first
    };

    const Poses& sampleAt(std::int64_t key);

    CharacterSettings m_settings;
    double m_rateHz;
    int m_stepsPerFrame;
    Identity m_identity;
    model::ReferenceBody m_body;
    std::unique_ptr<Motion> m_motion;
    TrackerSet m_trackers;
    std::array<Sample, 4> m_samples;
    CharacterMoment m_moment;
};

} // namespace posewire::performer
