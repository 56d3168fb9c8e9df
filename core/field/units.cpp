// SPDX-License-Identifier: MIT
#include "core/field/units.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace posewire::field {
namespace {

using enum Dimension;

constexpr double kPi = std::numbers::pi;
constexpr double kStandardGravity = 9.80665; // m/s²

constexpr std::array kUnits{
    UnitInfo{"m", Length, "metres"},
    UnitInfo{"cm", Length, "centimetres", 1, 100},
    UnitInfo{"mm", Length, "millimetres", 1, 1000},
    UnitInfo{"s", Time, "seconds"},
    UnitInfo{"ms", Time, "milliseconds", 1, 1000},
    UnitInfo{"us", Time, "microseconds", 1, 1e6},
    UnitInfo{"µs", Time, "microseconds", 1, 1e6},
    UnitInfo{"min", Time, "minutes", 60},
    UnitInfo{"h", Time, "hours", 3600},
    UnitInfo{"°", Angle, "degrees"},
    UnitInfo{"deg", Angle, "degrees"},
    UnitInfo{"rad", Angle, "radians", 180, kPi},
    UnitInfo{"m/s", Velocity, "metres per second"},
    UnitInfo{"cm/s", Velocity, "centimetres per second", 1, 100},
    UnitInfo{"mm/s", Velocity, "millimetres per second", 1, 1000},
    UnitInfo{"km/h", Velocity, "kilometres per hour", 10, 36},
    UnitInfo{"m/s²", Acceleration, "metres per second squared"},
    UnitInfo{"m/s2", Acceleration, "metres per second squared"},
    UnitInfo{"cm/s²", Acceleration, "centimetres per second squared", 1, 100},
    UnitInfo{"cm/s2", Acceleration, "centimetres per second squared", 1, 100},
    UnitInfo{"g", Acceleration, "9.80665 m/s²", kStandardGravity},
    UnitInfo{"°/s", AngularVelocity, "degrees per second"},
    UnitInfo{"deg/s", AngularVelocity, "degrees per second"},
    UnitInfo{"rad/s", AngularVelocity, "radians per second", 180, kPi},
    UnitInfo{"°/s²", AngularAcceleration, "degrees per second squared"},
    UnitInfo{"deg/s2", AngularAcceleration, "degrees per second squared"},
    UnitInfo{"rad/s²", AngularAcceleration, "radians per second squared", 180, kPi},
    UnitInfo{"rad/s2", AngularAcceleration, "radians per second squared", 180, kPi},
    UnitInfo{"bytes", Bytes, "bytes"},
    UnitInfo{"kB", Bytes, "1,000 bytes", 1000},
    UnitInfo{"KiB", Bytes, "1,024 bytes", 1024},
};

constexpr std::array<std::string_view, 9> kDimensions{"",
                                                      "a length",
                                                      "a time",
                                                      "an angle",
                                                      "a velocity",
                                                      "an acceleration",
                                                      "a velocity of turning",
                                                      "an acceleration of turning",
                                                      "a size"};

} // namespace

std::span<const UnitInfo> unitTable() {
    return kUnits;
}

std::span<const UnitInfo> unitsOf(Dimension dimension) {
    const auto* first = std::ranges::lower_bound(kUnits, dimension, {}, &UnitInfo::dimension);
    const auto* last = std::ranges::upper_bound(kUnits, dimension, {}, &UnitInfo::dimension);
    return {first, last};
}

const UnitInfo* findUnit(std::string_view symbol) {
    const auto* found = std::ranges::find(kUnits, symbol, &UnitInfo::symbol);
    return found != kUnits.end() ? found : nullptr;
}

double converted(double number, const UnitInfo& from, const UnitInfo& into) {
    return number * (from.times * into.per) / (from.per * into.times);
}

std::string_view dimensionName(Dimension dimension) {
    return kDimensions[static_cast<std::size_t>(dimension)];
}

std::string unitsText(Dimension dimension) {
    std::string text;
    const auto units = unitsOf(dimension);
    for (std::size_t i = 0; i < units.size(); ++i) {
        text.append(i == 0 ? "" : i + 1 == units.size() ? " or " : ", ").append(units[i].symbol);
    }
    return text;
}

} // namespace posewire::field
