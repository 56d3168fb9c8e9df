// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <numbers>

namespace posewire::model {

inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
inline constexpr double kGravity = 9.81; ///< m/s²

enum class LengthUnit : std::uint8_t { Metre, Centimetre, Millimetre };
/// Of a right-handed frame.
enum class UpAxis : std::uint8_t { Z, Y };

/// Metres per wire unit.
constexpr double metresPer(LengthUnit unit) {
    return unit == LengthUnit::Metre ? 1.0 : unit == LengthUnit::Centimetre ? 0.01 : 0.001;
}

/// Unit of a length on a human body, such as the height of the pelvis: bodies are shorter than five metres.
constexpr LengthUnit detectLengthUnit(double length) {
    const double size = length < 0 ? -length : length;
    return size > 500.0 ? LengthUnit::Millimetre : size > 5.0 ? LengthUnit::Centimetre : LengthUnit::Metre;
}

} // namespace posewire::model
