// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_counts.h"
#include "core/model/incidents/incidents.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>

/// Whether a loss is above its limit: in the list of incidents and in the verdict by the same rule.
namespace posewire::model {

/// Samples that did not come whole, of those that should have come.
struct LossShare {
    std::uint64_t lost = 0;
    std::uint64_t expected = 0;

    LossShare& operator+=(const LossShare& other);
    /// From 0 to 1; 0 where none were expected. By so many deviations more was lost, or less: that of what
    /// comes at random is the root of its count.
    [[nodiscard]] double ratio(double deviations = 0) const;
};

/// The share, from 0 to 1, of the worst character of a loss that lost more than the limit on all its streams
/// there, or of its worst stream that clearly did: of many streams that lose at random one is always above.
/// Nothing where none did, and for a limit of 0.
[[nodiscard]] std::optional<double>
shareAbove(double limitPercent, const Incident& incident,
           const std::function<LossShare(const Incident::Part&)>& shareOf);

/// What silences that ended in a range of time took of each stream, by cause: it counts at their end, when
/// the next sample came. Of all time where no range is given.
[[nodiscard]] std::unordered_map<log::StreamKey, LossesByCause>
lossesInSilences(const Incidents& incidents, const std::optional<TimeRange>& range);

} // namespace posewire::model
