// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/stream_index.h"
#include "core/model/accounting/stream_counts.h"
#include "core/model/incidents/incidents.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

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

/// The share, from 0 to 1, that each part of a loss is held to its limit by: what its character lost on all
/// its streams there, 0 where that is a few samples; or what it alone lost by more than chance, where that is
/// more: of many streams that lose at random one is always above what all lose together.
[[nodiscard]] std::vector<double>
judgedShares(const Incident& incident, const std::function<LossShare(const Incident::Part&)>& shareOf);

/// What silences that ended in a range of time took of each stream, by cause: it counts at their end, when
/// the next sample came. Of all time where no range is given.
[[nodiscard]] std::unordered_map<log::StreamKey, LossesByCause>
lossesInSilences(const Incidents& incidents, const std::optional<TimeRange>& range);

} // namespace posewire::model
