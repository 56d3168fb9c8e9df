// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// The units that a filter can be written in, and those that its fields are compared in.
namespace posewire::field {

/// What a number measures.
enum class Dimension : std::uint8_t {
    None,
    Length,
    Time,
    Angle,
    Velocity,
    Acceleration,
    AngularVelocity,
    AngularAcceleration,
    Bytes,
};

/// A number in this unit, times `times` and divided by `per`, is in the unit that its dimension is compared
/// in. Two numbers, so that 30 ms become the double nearest to 0.03 s.
struct UnitInfo {
    std::string_view symbol;
    Dimension dimension = Dimension::None;
    std::string_view text; ///< "centimetres"
    double times = 1;
    double per = 1;
};

/// All units, each dimension's together; the first is the one it is compared in.
[[nodiscard]] std::span<const UnitInfo> unitTable();
/// Those of one dimension.
[[nodiscard]] std::span<const UnitInfo> unitsOf(Dimension dimension);
/// Null if nothing is written so.
[[nodiscard]] const UnitInfo* findUnit(std::string_view symbol);

/// The same quantity in another unit of its dimension.
[[nodiscard]] double converted(double number, const UnitInfo& from, const UnitInfo& into);

/// "a length".
[[nodiscard]] std::string_view dimensionName(Dimension dimension);
/// "m, cm or mm": how its units are written.
[[nodiscard]] std::string unitsText(Dimension dimension);

} // namespace posewire::field
