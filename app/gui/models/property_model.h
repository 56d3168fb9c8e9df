// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

#include <QAbstractTableModel>

#include <functional>
#include <vector>

namespace posewire::gui {

/// The right side of a row: made whenever it is painted.
struct PropertyValue {
    QString text;
    Health health = Health::Unknown; ///< other than Unknown: shown with its symbol and colour
    QString toolTip = {};

    /// "▲ 31", or the text alone where health is unknown.
    [[nodiscard]] QString display() const;
    /// Of the health; nothing where it is unknown.
    [[nodiscard]] QVariant colour() const;
};

/// A row with a fixed label and a value that is read anew.
struct Property {
    QString label;
    std::function<PropertyValue()> read;
};

/// A small table of two columns: labels, dim and at the left, and values at the right.
class PropertyModel : public QAbstractTableModel {
    Q_OBJECT

public:
    explicit PropertyModel(std::vector<Property> properties, QObject* parent = nullptr);

    /// Announces that all values may have changed.
    void refresh();

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    std::vector<Property> m_properties;
};

} // namespace posewire::gui
