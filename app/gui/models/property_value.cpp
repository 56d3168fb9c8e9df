// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/property_value.h"

#include "app/gui/theme/words.h"

namespace posewire::gui {

namespace {

QString healthWord(Health health) {
    switch (health) {
    case Health::Good:
        return tr("good");
    case Health::Warning:
        return tr("warning");
    case Health::Error:
        return tr("error");
    case Health::Unknown:
        break;
    }
    return {};
}

} // namespace

QString PropertyValue::display() const {
    return health == Health::Unknown ? text : (healthSymbol(health) + QLatin1Char(' ') + text).trimmed();
}

QString PropertyValue::spoken() const {
    const QString word = healthWord(health);
    return word.isEmpty() || text.isEmpty() ? word + text : word + QLatin1String(", ") + text;
}

QVariant PropertyValue::colour() const {
    return health == Health::Unknown ? QVariant() : healthColour(health);
}

} // namespace posewire::gui
