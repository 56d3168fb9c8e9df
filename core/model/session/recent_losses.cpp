// SPDX-License-Identifier: MIT
#include "core/model/session/recent_losses.h"

#include "core/model/session/verdict.h"

#include <algorithm>

namespace posewire::model {
namespace {

std::size_t causeOf(const Incident& incident) {
    return static_cast<std::size_t>(incident.cause.value_or(LossCause::Unknown));
}

} // namespace

std::optional<words::Fact> RecentLosses::amountOf(const ListedIncident& one) {
    const Incident& incident = one.incident;
    const bool isOngoing = one.state == ListedIncident::State::Ongoing;
    const bool isLoss = incident.kind == IncidentKind::Loss || incident.kind == IncidentKind::Local;
    const bool isOlder =
        one.rangeEnd ||
        (m_range && incident.firstStamp < (isOngoing ? m_range->from : m_session.choices().reset));
    if (!isLoss || !isOlder || one.state == ListedIncident::State::Provisional || !incident.cause) {
        return {};
    }
    const LossShare sum = shareOf(incident);
    return sum.lost == 0 ? std::nullopt : std::optional(lostFact(incident, sum.lost, sum.expected));
}

bool RecentLosses::isAboveLimit(const Incident& incident) {
    const double window = m_session.verdicts().thresholds().windowS;
    const bool isUntilNow = m_range && m_range->to > m_session.now();
    if (isUntilNow && log::secondsOf(m_session.now() - m_range->from) >= window) {
        return std::ranges::any_of(incident.parts, &Incident::Part::isAbove);
    }
    const std::vector<double> shares =
        judgedShares(incident, [&](const Incident::Part& part) { return shareOf(part, causeOf(incident)); });
    const double limit =
        m_session.isRecording() ? incident.limit : m_session.verdicts().thresholds().lossPercent;
    return limit > 0 && std::ranges::any_of(shares, [&](double share) { return 100 * share > limit; });
}

LossShare RecentLosses::shareOf(const Incident& incident) {
    LossShare sum;
    for (const Incident::Part& part : incident.parts) {
        sum += shareOf(part, causeOf(incident));
    }
    return sum;
}

LossShare RecentLosses::shareOf(const Incident::Part& part, std::size_t cause) {
    const Stream* stream = streamOf(m_session, part);
    if (stream == nullptr) {
        return {};
    }
    if (!m_losses) {
        m_losses.emplace(m_session, m_range);
        m_silent = lossesInSilences(m_session.verdicts().incidents(), m_range);
    }
    const StreamLosses losses = m_losses->of(*stream);
    const auto silent = m_silent.find(stream->key);
    const std::uint64_t its = silent != m_silent.end() ? silent->second[cause] : 0;
    return {losses.byCause[cause] - std::min(losses.byCause[cause], its), losses.expected};
}

} // namespace posewire::model
