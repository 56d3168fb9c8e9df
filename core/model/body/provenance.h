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
    /// How long ago something last told how it is turned; 0 if something does now.
    float heldSeconds = 0;
    /// It was sent, and is of no use: not finite, or a quaternion of no length.
    bool isBroken = false;

    /// Of position and orientation, also of how it is turned about itself.
    [[nodiscard]] constexpr Provenance weaker() const {
        return std::min({position, orientation, isTwistAssumed ? Provenance::Assumed : Provenance::Sent});
    }
    friend constexpr bool operator==(const SegmentSource&, const SegmentSource&) = default;
};

} // namespace posewire::model
