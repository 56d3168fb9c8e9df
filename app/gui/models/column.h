// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

#include <QAbstractTableModel>
#include <QString>
#include <QVariant>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

namespace posewire::gui {

/// Painted by CellDelegate.
inline constexpr int kDotRole = Qt::UserRole + 1;       ///< CharacterMark before the text
inline constexpr int kSwatchRole = Qt::UserRole + 2;    ///< QColor: a square before the text
inline constexpr int kSuffixRole = Qt::UserRole + 3;    ///< QString: dim text after the text
inline constexpr int kShortTextRole = Qt::UserRole + 8; ///< QString: instead of a text without room
inline constexpr int kSeriesRole = Qt::UserRole + 4;    ///< QList<float>: a small curve; NaN breaks it
/// QList<float>: where the curve is to be marked, as many as it has values; 0 for no mark.
inline constexpr int kMarksRole = Qt::UserRole + 6;
/// QList<float>: a bar below a number: the ends of its range, of the part to be coloured, and a value.
inline constexpr int kBarRole = Qt::UserRole + 10;
/// ColumnRoom of a horizontal header.
inline constexpr int kRoomRole = Qt::UserRole + 9;

struct ColumnRoom {
    static constexpr int kOnChoice = -1;

    QString usual{};     ///< other columns leave before it gets narrower; figures in sight are whole anyway
    QString wish{};      ///< gets so wide if there is room; empty for the usual width
    QString least{};     ///< gets so narrow if no other column can leave; empty for the usual width
    int order = 0;       ///< leaves n-th if not all fit; 0: never; kOnChoice: shown only if chosen
    bool isOpen = false; ///< takes the room left; of several the last one that is shown
    int whole = 0;       ///< its words in sight count as usual up to so many characters, after what `usual`
                         ///< has before its first letter if that begins with a blank
};

/// Made whenever the cell is painted.
struct PropertyValue {
    QString text{};
    Health health = Health::Unknown; ///< other than Unknown: shown with its symbol and colour
    QString toolTip{};

    /// "▲ 31", or the text alone where health is unknown.
    [[nodiscard]] QString display() const;
    /// The same without a symbol, for screen readers: "warning, 31".
    [[nodiscard]] QString spoken() const;
    /// Nothing if the health is unknown.
    [[nodiscard]] QVariant colour() const;
};

/// For cells and headers of numbers: to the right, so that digits line up.
[[nodiscard]] QVariant numberAlignment();

/// The text of a cell as it is copied: with its suffix.
[[nodiscard]] QString cellText(const QModelIndex& index);

/// A column of a table whose rows are of type `Row`: plain functions of a row, called when a cell is painted
/// or read. What is left out stays empty, as on a line of text.
template <class Row>
struct TableColumn {
    using Words = std::function<QString(const Row&)>;
    using Colour = std::function<QVariant(const Row&)>;

    QString title{};
    QString help{}; ///< tooltip of the title
    bool isNumber = false;
    Words text{};
    ColumnRoom room{};
    Colour colour{}; ///< nothing for the usual one
    Words toolTip{}; ///< empty for none
    Words spoken{};  ///< for screen readers; the text where it is left out
    std::function<QVariant(const Row&, int role)> more{}; ///< the other roles

    [[nodiscard]] static TableColumn words(const QString& title, const QString& help, Words text) {
        return {.title = title, .help = help, .text = std::move(text)};
    }
    [[nodiscard]] static TableColumn numbers(const QString& title, const QString& help, Words text) {
        return {.title = title, .help = help, .isNumber = true, .text = std::move(text)};
    }
    [[nodiscard]] TableColumn in(ColumnRoom given) && {
        room = std::move(given);
        return std::move(*this);
    }
    [[nodiscard]] TableColumn withColour(Colour read) && {
        colour = std::move(read);
        return std::move(*this);
    }
    /// For labels, and for what follows from other cells.
    [[nodiscard]] TableColumn dimmed() && {
        return std::move(*this).withColour([](const Row&) { return QVariant(theme().dim); });
    }
    [[nodiscard]] TableColumn withToolTip(Words read) && {
        toolTip = std::move(read);
        return std::move(*this);
    }
    [[nodiscard]] TableColumn withMore(std::function<QVariant(const Row&, int role)> read) && {
        more = std::move(read);
        return std::move(*this);
    }
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
        return column.toolTip ? toolTipOf(column.toolTip(row)) : QVariant();
    case Qt::AccessibleTextRole:
        return orNothing(column.spoken);
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
        switch (role) {
        case Qt::DisplayRole:
            return column.title;
        case Qt::ToolTipRole:
            return toolTipOf(column.help);
        case Qt::TextAlignmentRole:
            return column.isNumber ? numberAlignment() : QVariant();
        case kRoomRole:
            return QVariant::fromValue(room(section));
        default:
            return {};
        }
    }

protected:
    /// A model whose columns need another room from now on announces a change of their headers.
    [[nodiscard]] virtual ColumnRoom room(int column) const {
        return m_columns[static_cast<std::size_t>(column)].room;
    }
    explicit ColumnModel(std::vector<TableColumn<Row>> columns) : m_columns(std::move(columns)) {}

    [[nodiscard]] QVariant cell(const Row& row, int column, int role) const {
        return cellData(m_columns[static_cast<std::size_t>(column)], row, role);
    }
    /// Announces, once, that all rows of the first level may have changed, with all under them.
    void announceChange() {
        if (const int rows = this->rowCount(); rows > 0) {
            emit this->dataChanged(this->index(0, 0), this->index(rows - 1, columnCount() - 1));
        }
    }

private:
    std::vector<TableColumn<Row>> m_columns;
};

/// A flat table that keeps its rows.
template <class Row>
class TableModel : public ColumnModel<Row> {
public:
    explicit TableModel(std::vector<TableColumn<Row>> columns) : ColumnModel<Row>(std::move(columns)) {}

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
        this->announceChange();
    }

private:
    std::vector<Row> m_rows;
};

/// A row with a fixed label and a value that is read anew with each refresh, so that all of a moment are of
/// that moment.
struct Property {
    QString label;
    std::function<PropertyValue()> read;
    PropertyValue value{}; ///< as it was read last
};

/// Properties that are read from `source`, which must outlive them.
template <class Source>
[[nodiscard]] std::vector<Property> propertiesOf(
    Source& source,
    std::initializer_list<std::pair<QString, PropertyValue (*)(std::type_identity_t<Source>&)>> rows) {
    std::vector<Property> properties;
    for (const auto& [label, read] : rows) {
        properties.push_back({label, [&source, read = read] { return read(source); }});
    }
    return properties;
}

/// A small table of two columns: labels, dim and at the left, and values at the right.
class PropertyModel : public TableModel<Property> {
public:
    explicit PropertyModel(std::vector<Property> properties);

    /// Reads all values.
    void refresh();
    /// From now on values are dim while that says that they are not how it is now.
    void dimWhile(std::function<bool()> isPast) { m_isPast = std::move(isPast); }

private:
    [[nodiscard]] std::vector<TableColumn<Property>> columns(const std::vector<Property>& properties) const;

    std::function<bool()> m_isPast;
};

} // namespace posewire::gui
