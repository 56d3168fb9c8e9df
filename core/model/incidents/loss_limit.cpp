// SPDX-License-Identifier: MIT
#include "core/model/incidents/loss_limit.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace posewire::model {
namespace {

double ratioOf(double lost, std::uint64_t expected) {
    return expected == 0 ? 0 : lost / static_cast<double>(expected);
}

double chanceOf(std::uint64_t lost) {
    constexpr double kDeviations = 2;
    return kDeviations * std::sqrt(static_cast<double>(lost));
}

} // namespace

LossShare& LossShare::operator+=(const LossShare& other) {
    lost += other.lost;
    expected += other.expected;
    return *this;
}

double LossShare::ratio() const {
    return ratioOf(static_cast<double>(lost), expected);
}

double LossShare::mostRatio() const {
    return ratioOf(static_cast<double>(lost) + chanceOf(lost), expected);
}

double LossShare::leastRatio() const {
    return ratioOf(static_cast<double>(lost) - chanceOf(lost), expected);
}

std::optional<double> shareAbove(double limitPercent, const Incident& incident,
                                 const std::function<LossShare(const Incident::Part&)>& shareOf) {
    const double limit = limitPercent / 100;
    if (limit <= 0) {
        return std::nullopt;
    }
    double worst = limit;
    std::map<std::uint8_t, LossShare> sums;
    for (const Incident::Part& part : incident.parts) {
        const LossShare share = shareOf(part);
        worst = share.leastRatio() > limit ? std::max(worst, share.ratio()) : worst;
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
