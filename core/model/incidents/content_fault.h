// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace posewire::model {

/// What is broken of the content that a sender sends.
enum class ContentFault : std::uint8_t {
    None,
    Frozen,
    Missing,
    Orientation,
    Number,
    ByteOrder,
    Counter,
    Framing,
    TimeCode,
    Jump,
    Convention,
    Floor,
    Units,
    Ids,
};
inline constexpr std::size_t kContentFaults = 14;

/// A row of the table below. Its cause is always the sender; what is said of it, with the remedy in MVN, is
/// in core/words.
struct ContentFaultFacts {
    ContentFault fault;
    std::string_view word; ///< of the contract for scripts
    bool isGrave;          ///< the take cannot be used, else a warning
    log::Duration after;   ///< for which it must go on before it counts: a damaged datagram is none
    bool lasts = true;     ///< until it is ended, else it happens at one moment
    bool isStrict = false; ///< one good sample ends it, else as many as it takes to outweigh the bad
};

inline constexpr std::array<ContentFaultFacts, kContentFaults> kContentFaultTable = [] {
    using F = ContentFault;
    using namespace std::chrono_literals;
    return std::array<ContentFaultFacts, kContentFaults>{{
        // The null pose is of another size than the body in the poses: of the kind Scale.
        {F::None, "", false, 400ms, true, true},
        // The pose is bit for bit the one before while the counter runs. A live stream never is for a second.
        {F::Frozen, "frozen", true, 1s, true, true},
        // The header announces segments, props or fingers, and the datagram has fewer.
        {F::Missing, "missing", true, 300ms},
        // The length of quaternions is below 0.5 or above 1.5; real ones are off by 1e-4.
        {F::Orientation, "orientation", true, 300ms},
        // Positions are not finite, or more than 10 km away.
        {F::Number, "number", true, 300ms},
        // Most items are unusable as they stand, and usable with their bytes exchanged.
        {F::ByteOrder, "byteOrder", true, 300ms},
        // Datagrams of other content repeat the sample counter of the one before.
        {F::Counter, "counter", false, 300ms},
        // No datagram is marked as the last of its sample and no sample has a second one, or the same one of
        // several is missing in each.
        {F::Framing, "framing", false, 300ms},
        // The time code runs at less than 0.4 or more than 2.5 × the speed of time: a busy sender or
        // a recording played at double speed is none.
        {F::TimeCode, "timeCode", false, 900ms, true, true},
        // The pelvis moves by 1.5 m and faster than 30 m/s between successive samples.
        {F::Jump, "jump", false, 0s, false},
        // Joints are more than 0.12 m from where parent and null pose put them; real ones 0.03 to 2.6 mm.
        {F::Convention, "convention", true, 900ms, true, true},
        // The lowest segment is more than 0.5 m from the floor. Who jumps lands within a second.
        {F::Floor, "convention", false, 1s, true, true},
        // The body is some metres tall in the unit that the specification has.
        {F::Units, "units", false, 300ms},
        // IDs begin at 0, or one occurs twice in a datagram.
        {F::Ids, "ids", false, 300ms},
    }};
}();

// Each once, in the order of the enum.
static_assert(std::ranges::adjacent_find(kContentFaultTable, std::ranges::greater_equal(),
                                         &ContentFaultFacts::fault) == kContentFaultTable.end());

inline const ContentFaultFacts& factsOf(ContentFault fault) {
    return kContentFaultTable[static_cast<std::size_t>(fault)];
}

} // namespace posewire::model
