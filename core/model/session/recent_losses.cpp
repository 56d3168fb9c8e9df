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

double RecentLosses::limitOf(const Incident& incident) const {
    return m_session.isRecording() ? incident.limit : m_session.verdicts().thresholds().lossPercent;
}

void RecentLosses::judge(Incident& incident) {
    const double window = m_session.verdicts().thresholds().windowS;
    const bool isUntilNow = m_range && m_range->to > m_session.now();
    if (incident.limit <= 0) {
        return;
    }
    if (!isUntilNow || log::secondsOf(m_session.now() - m_range->from) < window) {
        const std::vector<double> shares = judgedShares(
            incident, [&](const Incident::Part& part) { return shareOf(part, causeOf(incident)); });
        const double limit = limitOf(incident);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            incident.parts[i].isAbove = limit > 0 && 100 * shares[i] > limit;
        }
    }
    incident.value = std::ranges::any_of(incident.parts, &Incident::Part::isAbove) ? incident.value : 0;
}

Incident RecentLosses::shownOf(const Incident& incident) {
    const bool isGrave =
        incident.kind == IncidentKind::Loss && incident.severity() == IncidentSeverity::Error;
    if (!isGrave || 100 * shareOf(incident).ratio() > limitOf(incident)) {
        return incident;
    }
    const Incident grave = incident.without(
        [](const Incident::Part& part) { return !part.isAbove && !part.lastMany.has_value(); });
    return grave.parts.empty() ? incident : grave;
}

LossShare RecentLosses::shareOf(const Incident& incident) {
    LossShare sum;
    for (const Incident::Part& part : incident.parts) {
        sum += part.isSampled() || incident.isOfMessages() ? shareOf(part, causeOf(incident)) : LossShare();
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
