// SPDX-License-Identifier: MIT
#include "core/model/incidents/loss_limit.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace posewire::model {

LossShare& LossShare::operator+=(const LossShare& other) {
    lost += other.lost;
    expected += other.expected;
    return *this;
}

double LossShare::ratio(double deviations) const {
    const auto count = static_cast<double>(lost);
    return expected == 0 ? 0 : (count + deviations * std::sqrt(count)) / static_cast<double>(expected);
}

std::optional<double> shareAbove(double limitPercent, const Incident& incident,
                                 const std::function<LossShare(const Incident::Part&)>& shareOf) {
    const double limit = limitPercent / 100;
    if (limit <= 0) {
        return std::nullopt;
    }
    constexpr double kClearly = -2;
    double worst = limit;
    std::map<std::uint8_t, LossShare> sums;
    for (const Incident::Part& part : incident.parts) {
        const LossShare share = shareOf(part);
        worst = share.ratio(kClearly) > limit ? std::max(worst, share.ratio()) : worst;
        sums[part.character.value_or(0)] += share;
    }
    for (const auto& [character, share] : sums) {
        worst = share.lost >= Incident::kFewSamples ? std::max(worst, share.ratio()) : worst;
    }
    return worst > limit ? std::optional(worst) : std::nullopt;
}

std::unordered_map<log::StreamKey, LossesByCause> lossesInSilences(const Incidents& incidents,
                                                                   const std::optional<TimeRange>& range) {
    std::unordered_map<log::StreamKey, LossesByCause> losses;
    for (const Incident& outage : incidents.all()) {
        const bool isMeant = !range || (outage.lastStamp >= range->from && outage.lastStamp < range->to);
        if (outage.kind != IncidentKind::Outage || !isMeant) {
            continue;
        }
        const auto cause = static_cast<std::size_t>(outage.cause.value_or(LossCause::Unknown));
        for (const Incident::Part& part : outage.parts) {
            if (part.character && part.type) {
                losses[{outage.sender, *part.character, *part.type}][cause] += part.samples;
            }
        }
    }
    return losses;
}

} // namespace posewire::model
