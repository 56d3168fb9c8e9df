// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/property_model.h"

namespace posewire::gui {

namespace {

QVariant valueData(const PropertyValue& value, int role) {
    switch (role) {
    case Qt::DisplayRole:
        return value.display();
    case Qt::ForegroundRole:
        return value.colour();
    case Qt::ToolTipRole:
        return value.toolTip.isEmpty() ? QVariant() : value.toolTip;
    case Qt::TextAlignmentRole:
        return QVariant::fromValue(Qt::AlignRight | Qt::AlignVCenter);
    default:
        return {};
    }
}

} // namespace

QString PropertyValue::display() const {
    return health == Health::Unknown ? text : healthSymbol(health) + QLatin1Char(' ') + text;
}

QVariant PropertyValue::colour() const {
    return health == Health::Unknown ? QVariant() : healthColour(health);
}

PropertyModel::PropertyModel(std::vector<Property> properties, QObject* parent)
    : QAbstractTableModel(parent), m_properties(std::move(properties)) {}

void PropertyModel::refresh() {
    if (!m_properties.empty()) {
        emit dataChanged(index(0, 1), index(rowCount() - 1, 1));
    }
}

int PropertyModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(m_properties.size());
}

int PropertyModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : 2;
}

QVariant PropertyModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return {};
    }
    const Property& property = m_properties[static_cast<std::size_t>(index.row())];
    if (index.column() == 1) {
        return valueData(property.read(), role);
    }
    switch (role) {
    case Qt::DisplayRole:
        return property.label;
    case Qt::ForegroundRole:
        return theme().dim;
    case Qt::ToolTipRole: {
        const QString toolTip = property.read().toolTip;
        return toolTip.isEmpty() ? QVariant() : toolTip;
    }
    default:
        return {};
    }
}

QVariant PropertyModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) {
        return {};
    }
    return section == 0 ? tr("Property") : tr("Value");
}

} // namespace posewire::gui
