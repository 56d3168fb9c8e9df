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

std::vector<double> judgedShares(const Incident& incident,
                                 const std::function<LossShare(const Incident::Part&)>& shareOf) {
    constexpr double kClearly = -2;
    std::vector<double> shares;
    std::map<std::uint8_t, LossShare> sums;
    for (const Incident::Part& part : incident.parts) {
        const LossShare share = shareOf(part);
        shares.push_back(share.ratio(kClearly));
        sums[part.character.value_or(0)] += share;
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const LossShare& all = sums[incident.parts[i].character.value_or(0)];
        shares[i] = std::max(shares[i], all.lost >= Incident::kFewSamples ? all.ratio() : 0);
    }
    return shares;
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
