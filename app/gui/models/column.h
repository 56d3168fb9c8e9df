// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_value.h"
#include "app/gui/models/roles.h"

#include <QAbstractTableModel>

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace posewire::gui {

/// For cells and headers of numbers: to the right, so that digits line up.
[[nodiscard]] QVariant numberAlignment();

/// What is over a column. `help` is the tooltip; empty for none.
[[nodiscard]] QVariant headerCell(const QString& title, const QString& help, bool isNumber, int role);

/// The text of a cell as it is copied: with its suffix.
[[nodiscard]] QString cellText(const QModelIndex& index);

/// A column of a table whose rows are of type `Row`: plain functions of a row, called when a cell is painted
/// or read. What is left out stays empty, as on a line of text.
template <class Row>
struct TableColumn {
    QString title{};
    QString help{}; ///< tooltip of the title
    bool isNumber = false;
    std::function<QString(const Row&)> text{};
    std::function<QVariant(const Row&)> colour{};  ///< nothing for the usual one
    std::function<QString(const Row&)> toolTip{};  ///< empty for none
    std::function<QVariant(const Row&)> sortKey{}; ///< the text where it is left out
    std::function<QString(const Row&)> spoken{};   ///< for screen readers; the text where it is left out
    std::function<QVariant(const Row&, int role)> more{}; ///< the other roles
};

/// A cell whose text and colour follow from one judgement.
template <class Row, class Read>
[[nodiscard]] TableColumn<Row> valueColumn(TableColumn<Row> column, Read read) {
    column.text = [read](const Row& row) { return PropertyValue(read(row)).display(); };
    column.colour = [read](const Row& row) { return PropertyValue(read(row)).colour(); };
    column.spoken = [read](const Row& row) { return PropertyValue(read(row)).spoken(); };
    if (!column.toolTip) {
        column.toolTip = [read](const Row& row) { return PropertyValue(read(row)).toolTip; };
    }
    return column;
}

/// Cells that say nothing else in their tooltip explain their column.
template <class Row>
[[nodiscard]] std::vector<TableColumn<Row>> withHelpInCells(std::vector<TableColumn<Row>> columns) {
    for (TableColumn<Row>& column : columns) {
        column.toolTip = [help = column.help, own = column.toolTip](const Row& row) {
            const QString text = own ? own(row) : QString();
            return text.isEmpty() ? help : text;
        };
    }
    return columns;
}

template <class Row>
[[nodiscard]] QVariant cellData(const TableColumn<Row>& column, const Row& row, int role) {
    const auto orNothing = [&row](const auto& read) {
        const QString text = read ? read(row) : QString();
        return text.isEmpty() ? QVariant() : QVariant(text);
    };
    switch (role) {
    case Qt::DisplayRole:
        return column.text ? QVariant(column.text(row)) : QVariant();
    case Qt::ForegroundRole:
        return column.colour ? column.colour(row) : QVariant();
    case Qt::TextAlignmentRole:
        return column.isNumber ? numberAlignment() : QVariant();
    case Qt::ToolTipRole:
        return orNothing(column.toolTip);
    case Qt::AccessibleTextRole:
        return orNothing(column.spoken);
    case kSortRole:
        return column.sortKey ? column.sortKey(row) : cellData(column, row, Qt::DisplayRole);
    default:
        return column.more ? column.more(row, role) : QVariant();
    }
}

/// A model that is its columns; where its rows come from is up to whoever derives from it. `Base` is
/// QAbstractItemModel for trees.
template <class Row, class Base = QAbstractTableModel>
class ColumnModel : public Base {
public:
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override {
        constexpr bool kIsTree = !std::is_same_v<Base, QAbstractTableModel>;
        return kIsTree || !parent.isValid() ? static_cast<int>(m_columns.size()) : 0;
    }
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override {
        if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) {
            return {};
        }
        const TableColumn<Row>& column = m_columns[static_cast<std::size_t>(section)];
        return headerCell(column.title, column.help, column.isNumber, role);
    }

protected:
    explicit ColumnModel(std::vector<TableColumn<Row>> columns, QObject* parent = nullptr)
        : Base(parent), m_columns(std::move(columns)) {}

    [[nodiscard]] QVariant cell(const Row& row, int column, int role) const {
        return cellData(m_columns[static_cast<std::size_t>(column)], row, role);
    }
    /// Announces that the rows from `first` to `last` of the first level may have changed, with all under
    /// them.
    void announceChange(int first, int last) {
        if (last >= first) {
            emit this->dataChanged(this->index(first, 0), this->index(last, columnCount() - 1));
        }
    }

private:
    std::vector<TableColumn<Row>> m_columns;
};

/// A flat table that keeps its rows.
template <class Row>
class TableModel : public ColumnModel<Row> {
public:
    explicit TableModel(std::vector<TableColumn<Row>> columns, QObject* parent = nullptr)
        : ColumnModel<Row>(std::move(columns), parent) {}

    [[nodiscard]] const std::vector<Row>& rows() const { return m_rows; }

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override {
        return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
    }
    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override {
        return this->checkIndex(index, QAbstractItemModel::CheckIndexOption::IndexIsValid)
                   ? this->cell(m_rows[static_cast<std::size_t>(index.row())], index.column(), role)
                   : QVariant();
    }

protected:
    /// Announces at most one insertion or removal, at the end, and one change.
    void setRows(std::vector<Row> rows) {
        const int before = rowCount();
        const int after = static_cast<int>(rows.size());
        if (after > before) {
            this->beginInsertRows({}, before, after - 1);
            m_rows.insert(m_rows.end(), rows.begin() + before, rows.end());
            this->endInsertRows();
        } else if (after < before) {
            this->beginRemoveRows({}, after, before - 1);
            m_rows.erase(m_rows.begin() + after, m_rows.end());
            this->endRemoveRows();
        }
        m_rows = std::move(rows);
        this->announceChange(0, after - 1);
    }

private:
    std::vector<Row> m_rows;
};

} // namespace posewire::gui
