// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/alert_choices.h"

namespace posewire::gui {

namespace {

QLatin1String keyOf(const model::ThresholdRow& row) {
    return {row.key.data(), static_cast<qsizetype>(row.key.size())};
}

} // namespace

QJsonObject jsonOf(const AlertChoices& choices) {
    QJsonObject object;
    for (const model::ThresholdRow& row : model::thresholdTable()) {
        object[keyOf(row)] = choices.thresholds.*row.limit;
    }
    object["warningSound"] = choices.hasWarningSound;
    object["errorSound"] = choices.hasErrorSound;
    object["notification"] = choices.hasNotification;
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
    choices.hasNotification = object["notification"].toBool();
    return choices;
}

} // namespace posewire::gui
