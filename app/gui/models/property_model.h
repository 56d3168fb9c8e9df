// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"

namespace posewire::gui {

/// A row with a fixed label and a value that is read whenever it is painted.
struct Property {
    QString label;
    std::function<PropertyValue()> read;
};

/// A small table of two columns: labels, dim and at the left, and values at the right.
class PropertyModel : public TableModel<Property> {
public:
    explicit PropertyModel(std::vector<Property> properties, QObject* parent = nullptr);

    /// Announces that all values may have changed.
    void refresh() { announceChange(0, rowCount() - 1); }
};

} // namespace posewire::gui
