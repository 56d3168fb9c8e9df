// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/alerts.h"

#include "core/model/accounting/thresholds.h"

#include <utility>

namespace posewire::gui {

namespace {

QLatin1String keyOf(const model::ThresholdRow& row) {
    return {row.key.data(), static_cast<qsizetype>(row.key.size())};
}

bool isWanted(const model::Event& event, const AlertChoices& choices) {
    return (choices.hasErrorSound && event.severity() == model::EventSeverity::Error) ||
           (choices.hasWarningSound && event.severity() == model::EventSeverity::Warning);
}

} // namespace

QJsonObject jsonOf(const AlertChoices& choices) {
    QJsonObject object;
    for (const model::ThresholdRow& row : model::thresholdTable()) {
        object[keyOf(row)] = choices.thresholds.*row.limit;
    }
    object["warningSound"] = choices.hasWarningSound;
    object["errorSound"] = choices.hasErrorSound;
    return object;
}

AlertChoices alertChoicesOf(const QJsonObject& object) {
    AlertChoices choices;
    for (const model::ThresholdRow& row : model::thresholdTable()) {
        const double value = object[keyOf(row)].toDouble(-1);
        if (value >= row.least && value <= row.most) {
            choices.thresholds.*row.limit = value;
        }
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
