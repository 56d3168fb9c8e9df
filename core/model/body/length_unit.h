// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace posewire::model {

/// What a sender's positions are in.
enum class LengthUnit : std::uint8_t { Metre, Centimetre };

/// Metres per wire unit.
constexpr double metresPer(LengthUnit unit) {
    return unit == LengthUnit::Metre ? 1.0 : 0.01;
}

/// Metres or centimetres, by a length of about a human's size in wire units, such as the height of a pelvis
/// or how far the segments reach from it: nobody is five metres tall.
constexpr LengthUnit detectLengthUnit(double length) {
    return length > 5.0 || length < -5.0 ? LengthUnit::Centimetre : LengthUnit::Metre;
}

} // namespace posewire::model
