// SPDX-License-Identifier: MIT
#include "core/performer/motion.h"

#include "core/performer/stand_motion.h"
#include "core/performer/walk_motion.h"

#include <array>
#include <limits>

namespace posewire::performer {
namespace {

constexpr std::array<std::string_view, 5> kNames{"walk", "idle", "wave", "squat", "tpose"};

} // namespace

double Motion::sinceHeelStrike(model::Side /*side*/, double /*seconds*/) const {
    return std::numeric_limits<double>::infinity();
}

std::span<const std::string_view> motionNames() {
    return kNames;
}

std::unique_ptr<Motion> makeMotion(std::string_view name, const MotionSettings& settings) {
    if (name == "walk") {
        return std::make_unique<WalkMotion>(settings);
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
    if (name == "tpose") {
        return std::make_unique<TPoseMotion>(settings);
    }
    return nullptr;
}

} // namespace posewire::performer
