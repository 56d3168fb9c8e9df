// SPDX-License-Identifier: MIT
#include "core/performer/motion.h"

#include <array>

namespace posewire::performer {
namespace {

constexpr std::array<std::string_view, 5> kNames{"walk", "idle", "wave", "squat", "tpose"};

} // namespace

std::span<const std::string_view> motionNames() {
    return kNames;
}

std::unique_ptr<Motion> makeMotion(std::string_view name, const MotionSettings& settings) {
    if (name == "walk") {
        return makeWalk(settings);
    }
    if (name == "idle") {
        return makeStanding(settings, StandAction::Idle);
    }
    if (name == "wave") {
        return makeStanding(settings, StandAction::Wave);
    }
    if (name == "squat") {
        return makeStanding(settings, StandAction::Squat);
    }
    return name == "tpose" ? makeTPose(settings) : nullptr;
}

} // namespace posewire::performer
