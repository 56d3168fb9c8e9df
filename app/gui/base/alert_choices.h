// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/incidents/thresholds.h"

#include <QJsonObject>

namespace posewire::gui {

/// When the operator wants to be alerted, and how: kept from one run to the next.
struct AlertChoices {
    model::Thresholds thresholds;
    bool hasWarningSound = false;
    bool hasErrorSound = false;
    bool hasNotification = false; ///< by the desktop, when the verdict turns bad
    friend bool operator==(const AlertChoices&, const AlertChoices&) = default;
};

[[nodiscard]] QJsonObject jsonOf(const AlertChoices& choices);
/// What is missing or makes no sense is as shipped.
[[nodiscard]] AlertChoices alertChoicesOf(const QJsonObject& object);

} // namespace posewire::gui
