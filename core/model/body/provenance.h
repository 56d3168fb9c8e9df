// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

namespace posewire::model {

/// The weakest first.
enum class Provenance : std::uint8_t {
    None,    ///< there is none
    Assumed, ///< nothing that was sent fixes it
    Solved,  ///< follows from what was sent
    Sent,
};

struct SegmentSource {
    Provenance position = Provenance::None;
    Provenance orientation = Provenance::None;
    /// The direction of the segment is known, how it is turned about itself is not.
    bool isTwistAssumed = false;
    /// It was sent, and is of no use: not finite, or a quaternion of no length.
    bool isBroken = false;

    [[nodiscard]] constexpr Provenance weaker() const { return std::min(position, orientation); }
    friend constexpr bool operator==(const SegmentSource&, const SegmentSource&) = default;
};

} // namespace posewire::model
