// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/alerts.h"

#include <array>
#include <utility>

namespace posewire::gui {

namespace {

using Limit = std::pair<const char*, double model::Thresholds::*>;

constexpr std::array<Limit, 7> kLimits{{{"lossPercent", &model::Thresholds::lossPercent},
                                        {"jitterMs", &model::Thresholds::jitterMs},
                                        {"gapMs", &model::Thresholds::gapMs},
                                        {"ageS", &model::Thresholds::ageS},
                                        {"ratePercent", &model::Thresholds::ratePercent},
                                        {"windowS", &model::Thresholds::windowS},
                                        {"hysteresis", &model::Thresholds::hysteresis}}};
constexpr double kMost = 1e6;

bool isWanted(const model::Event& event, const AlertChoices& choices) {
    return (choices.hasErrorSound && event.severity() == model::EventSeverity::Error) ||
           (choices.hasWarningSound && event.severity() == model::EventSeverity::Warning);
}

} // namespace

QJsonObject jsonOf(const AlertChoices& choices) {
    QJsonObject object;
    for (const auto& [name, limit] : kLimits) {
        object[QLatin1String(name)] = choices.thresholds.*limit;
    }
    object["warningSound"] = choices.hasWarningSound;
    object["errorSound"] = choices.hasErrorSound;
    return object;
}

AlertChoices alertChoicesOf(const QJsonObject& object) {
    AlertChoices choices;
    for (const auto& [name, limit] : kLimits) {
        const double value = object[QLatin1String(name)].toDouble(-1);
        if (value >= 0 && value <= kMost) {
            choices.thresholds.*limit = value;
        }
    }
    const model::Thresholds shipped;
    if (choices.thresholds.windowS < 1) {
        choices.thresholds.windowS = shipped.windowS;
    }
    if (choices.thresholds.hysteresis > 1) {
        choices.thresholds.hysteresis = shipped.hysteresis;
    }
    choices.hasWarningSound = object["warningSound"].toBool();
    choices.hasErrorSound = object["errorSound"].toBool();
    return choices;
}

bool AlertSounds::isDue(const model::Events& events, const AlertChoices& choices) {
    bool isDue = false;
    for (auto event = events.all().rbegin(); event != events.all().rend() && event->number >= m_end;
         ++event) {
        isDue = isDue || isWanted(*event, choices);
    }
    m_end = events.all().empty() ? m_end : events.all().back().number + 1;
    return !std::exchange(m_isFirst, false) && isDue;
}

} // namespace posewire::gui
