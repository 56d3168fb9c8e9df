// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/kinematics.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

namespace posewire::performer {

/// A movement of one body for all time: a pure function of the time, continuous with its first two
/// derivatives (but for where a motion is built of pieces, whose second derivative may have corners).
class Motion {
public:
    virtual ~Motion() = default;

    /// The 23 segments in the world at `seconds` after the start; may be negative.
    virtual BodyPose sample(double seconds) const = 0;

    /// Seconds since the heel of that side last struck the floor; infinite for motions without steps.
    virtual double sinceHeelStrike(model::Side /*side*/, double /*seconds*/) const {
        return std::numeric_limits<double>::infinity();
    }
};

struct MotionSettings {
    model::ReferenceBody body;
    std::uint64_t seed = 1;
    int character = 0;      ///< its place among
    int characterCount = 1; ///< all that share the floor
};

std::unique_ptr<Motion> makeWalk(const MotionSettings& settings);

/// "walk", "idle", "wave", "squat", "tpose".
std::span<const std::string_view> motionNames();

/// Null for a name that is not in motionNames().
std::unique_ptr<Motion> makeMotion(std::string_view name, const MotionSettings& settings);

} // namespace posewire::performer
