// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/incidents/content_fault.h"
#include "core/wire/codec.h"
#include "core/words/fact.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace posewire::model {

/// One fault in numbers, so that none is said before it counts.
struct ContentFinding {
    ContentFault fault = ContentFault::None;
    words::Kind says = words::Kind::Nothing;
    std::uint16_t count = 0;                  ///< segments
    std::uint16_t props = 0;                  ///< Missing alone
    std::uint16_t fingers = 0;                ///< Missing alone
    words::Kind looks = words::Kind::Nothing; ///< the unit or convention that fits
    double value = 0;                         ///< Jump: metres; Units: how often the null pose

    friend bool operator==(const ContentFinding&, const ContentFinding&) = default;
};
[[nodiscard]] words::Fact factOf(const ContentFinding& finding);

/// What one datagram of a pose shows, looked at alone.
struct PoseChecks {
    std::array<ContentFinding, 4> findings{};
    std::size_t count = 0;
    std::uint8_t bodyItems = 0; ///< segments of the body that it has, of all datagrams of its sample if whole
    bool isWhole = false;       ///< its sample is in this one datagram
    bool isOfObjects = false;   ///< see isOfObjects() of core/model/body
    bool isUnusable = false;    ///< numbers, orientations or bytes: nothing else can be said of it
    std::array<float, 3> first{}; ///< position of its first item, in the wire's unit

    [[nodiscard]] const ContentFinding* find(ContentFault fault) const;
};

/// Of types 01, 02, 05, 21 and 22; of others nothing. `mostBodyItems`: so many have come before, where the
/// header does not say how many there are.
[[nodiscard]] PoseChecks checkPose(const wire::Datagram& datagram, std::uint8_t mostBodyItems);

} // namespace posewire::model
