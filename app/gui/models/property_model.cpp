// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/property_model.h"

#include "app/gui/theme/words.h"

namespace posewire::gui {

PropertyModel::PropertyModel(std::vector<Property> properties, QObject* parent)
    : TableModel({{.title = tr("Property"),
                   .text = [](const Property& row) { return row.label; },
                   .colour = [](const Property&) { return QVariant(theme().dim); },
                   .toolTip = [](const Property& row) { return row.read().toolTip; }},
                  valueColumn(TableColumn<Property>{.title = tr("Value"), .isNumber = true},
                              [](const Property& row) { return row.read(); })},
                 parent) {
    setRows(std::move(properties));
}

} // namespace posewire::gui
