// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/incidents/loss_limit.h"
#include "core/model/session/fault_matrix.h"
#include "core/model/session/listed_incidents.h"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace posewire::model {

/// What streams lost in the time that a verdict is of, but for what silences took: those are incidents of
/// their own. Read once, where it is asked for; valid until the session follows the log again.
class RecentLosses {
public:
    /// All there is where no range is given.
    RecentLosses(const SessionView& session, const std::optional<TimeRange>& range)
        : m_session(session), m_range(range) {}

    /// "2.1 %", or "37 samples" with a noun: how much of what has gone on since before that time is lost in
    /// it. Empty for what is told whole: what began in it, or is over, so that it does not grow less, and
    /// began after the reset.
    [[nodiscard]] std::string amountOf(const ListedIncident& one, std::string_view noun);
    /// Whether a part of it is above its limit: now, with the hysteresis of limits; of all there is, or just
    /// after a reset, in that time.
    [[nodiscard]] bool isAboveLimit(const Incident& incident);
    /// What the streams of an incident lost.
    [[nodiscard]] LossShare shareOf(const Incident& incident);

private:
    [[nodiscard]] FaultCounts countsOf(log::SenderId sender, const Incident::Part& part);
    [[nodiscard]] FaultCounts sumOf(const Incident& incident);

    const SessionView& m_session;
    std::optional<TimeRange> m_range;
    std::optional<Losses> m_losses;
    std::unordered_map<log::StreamKey, LossesByCause> m_silent;
};

} // namespace posewire::model
