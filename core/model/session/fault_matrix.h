// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/losses.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::model {

/// Samples that did not come whole, by whose loss it was, among those that should have come.
struct FaultCounts {
    LossesByCause lost{};
    std::uint64_t pending = 0;  ///< not here yet, and not yet lost: late packets may still bring them
    std::uint64_t expected = 0; ///< 0 also where that is not known: of messages sent again and again

    [[nodiscard]] std::uint64_t total() const;
    /// 0 if no samples were expected.
    [[nodiscard]] double shareOf(std::uint64_t samples) const;
    FaultCounts& operator+=(const FaultCounts& other);
};

/// Under all ports that its sender had.
struct StreamFaults {
    std::uint8_t type = 0;
    FaultCounts counts{};
    std::vector<log::StreamKey> streams{};
};

/// Through the restarts of its sender.
struct CharacterFaults {
    CharacterKey first{};   ///< of the oldest sender that is remembered: stays through restarts
    CharacterKey current{}; ///< what it is called by
    FaultCounts counts{};
    std::vector<StreamFaults> streams{}; ///< by type; messages without samples only where some are incomplete
};

/// Sums of what the streams of a session lost in one range of time.
struct FaultMatrix {
    std::vector<CharacterFaults> characters; ///< in order of first appearance
    /// Of all characters that may be no more than corrupt headers; nothing if nothing came of them.
    std::optional<CharacterFaults> unconfirmed;
    FaultCounts sum;
};

/// Of all there is where no range is given. Who is who is decided at the cursor.
[[nodiscard]] FaultMatrix faultMatrix(const SessionView& session, const std::optional<TimeRange>& range);

} // namespace posewire::model
