// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/incidents/thresholds.h"
#include "core/model/session/listed_incidents.h"
#include "core/model/session/losses.h"

#include <optional>
#include <unordered_map>

namespace posewire::model {

/// What streams lost in the time that a verdict is of, but for what silences took: those are incidents of
/// their own. Read once, where it is asked for; valid until the session follows the log again.
class RecentLosses {
public:
    /// All there is where no range is given.
    RecentLosses(const SessionView& session, const std::optional<TimeRange>& range)
        : m_session(session), m_range(range) {}

    /// How much a loss that began before that time lost in it. Nothing if the whole loss is reported: it
    /// began in that time, or it is over, so that the figure does not shrink, and began after the reset.
    [[nodiscard]] std::optional<words::Fact> amountOf(const ListedIncident& one);
    /// Notes which parts of it are above their limit: now, with the hysteresis of limits; of all there is, or
    /// just after a reset, in that time. It is graver only while one is.
    void judge(Incident& incident);
    /// The parts of a grave loss to show: all, or only those above the limit if all together are below it, so
    /// that no share below the limit is shown as the fault.
    [[nodiscard]] Incident shownOf(const Incident& incident);
    [[nodiscard]] LossShare shareOf(const Incident& incident);

private:
    [[nodiscard]] LossShare shareOf(const Incident::Part& part, std::size_t cause);
    [[nodiscard]] double limitOf(const Incident& incident) const; ///< percent

    const SessionView& m_session;
    std::optional<TimeRange> m_range;
    std::optional<Losses> m_losses;
    std::unordered_map<log::StreamKey, LossesByCause> m_silent;
};

} // namespace posewire::model
