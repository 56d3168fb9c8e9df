// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/column.h"

#include "app/gui/theme/words.h"

#include <array>

namespace posewire::gui {

QString PropertyValue::display() const {
    return health == Health::Unknown ? text : healthText(health, text).trimmed();
}

QString PropertyValue::spoken() const {
    const std::array words{tr("good"), tr("warning"), tr("error"), QString()}; // by Health
    const QString& word = words[static_cast<std::size_t>(health)];
    return word.isEmpty() || text.isEmpty() ? word + text : word + QLatin1String(", ") + text;
}

QVariant PropertyValue::colour() const {
    return health == Health::Unknown ? QVariant() : healthColour(health);
}

QVariant numberAlignment() {
    return int{Qt::AlignRight | Qt::AlignVCenter};
}

QString cellText(const QModelIndex& index) {
    const QString text = index.data(Qt::DisplayRole).toString();
    const QString suffix = index.data(kSuffixRole).toString();
    return suffix.isEmpty() ? text : text + QLatin1Char(' ') + suffix;
}

PropertyModel::PropertyModel(std::vector<Property> properties) : TableModel(columns(properties)) {
    setRows(std::move(properties));
    refresh();
}

void PropertyModel::refresh() {
    std::vector<Property> properties = rows();
    for (Property& property : properties) {
        property.value = property.read();
    }
    setRows(std::move(properties));
}

std::vector<TableColumn<Property>> PropertyModel::columns(const std::vector<Property>& properties) const {
    const auto longest = std::ranges::max_element(
        properties, {}, [](const Property& property) { return property.label.size(); });
    auto value = valueColumn(TableColumn<Property>{.title = tr("Value"), .isNumber = true},
                             [](const Property& row) { return row.value; });
    value.colour = [this, own = value.colour](const Property& row) {
        return m_isPast && m_isPast() ? QVariant(theme().dim) : own(row);
    };
    value.room = {.usual = QStringLiteral("12345678"), .isOpen = true};
    return {TableColumn<Property>::words(tr("Property"), {}, &Property::label)
                .in({longest == properties.end() ? QString() : longest->label})
                .dimmed()
                .withToolTip([](const Property& row) { return row.value.toolTip; }),
            std::move(value)};
}

} // namespace posewire::gui
