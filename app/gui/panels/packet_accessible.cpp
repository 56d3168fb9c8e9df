// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/column.h"
#include "app/gui/panels/fitting_header.h"
#include "app/gui/panels/packet_view.h"

#include <QAccessible>
#include <QAccessibleWidget>
#include <QPointer>

#include <algorithm>
#include <map>

namespace posewire::gui {

namespace {

std::vector<int> shownColumns(const PacketView& view) {
    std::vector<int> columns;
    for (int column = 0; column < view.header().count(); ++column) {
        if (!view.header().isSectionHidden(column)) {
            columns.push_back(column);
        }
    }
    return columns;
}

/// The cell at a place in sight; invalid if that is empty by now.
QModelIndex cellIn(const PacketView& view, int row, int column) {
    const std::vector<int> columns = shownColumns(view);
    const bool isPlace = row >= 0 && row < view.wholeRows() && column >= 0 && column < std::ssize(columns);
    return isPlace && view.model() != nullptr
               ? view.model()->index(view.topRow() + row, columns[static_cast<std::size_t>(column)])
               : QModelIndex();
}

/// A place in sight, whatever packet is there.
class PacketCell final : public QAccessibleInterface, public QAccessibleTableCellInterface {
public:
    PacketCell(PacketView* view, int row, int column) : m_view(view), m_row(row), m_column(column) {}

    [[nodiscard]] bool isValid() const override { return m_view != nullptr && index().isValid(); }
    [[nodiscard]] QObject* object() const override { return nullptr; }
    [[nodiscard]] QAccessibleInterface* parent() const override {
        return QAccessible::queryAccessibleInterface(m_view);
    }
    [[nodiscard]] QAccessibleInterface* child(int) const override { return nullptr; }
    [[nodiscard]] QAccessibleInterface* childAt(int, int) const override { return nullptr; }
    [[nodiscard]] int childCount() const override { return 0; }
    [[nodiscard]] int indexOfChild(const QAccessibleInterface*) const override { return -1; }
    [[nodiscard]] QAccessible::Role role() const override { return QAccessible::Cell; }
    [[nodiscard]] QString text(QAccessible::Text text) const override {
        if (text != QAccessible::Name || !isValid()) {
            return {};
        }
        const QString spoken = index().data(Qt::AccessibleTextRole).toString();
        return spoken.isEmpty() ? cellText(index()) : spoken;
    }
    void setText(QAccessible::Text, const QString&) override {}
    [[nodiscard]] QRect rect() const override {
        const QRect cell = m_view->visualRect(index());
        return {m_view->viewport()->mapToGlobal(cell.topLeft()), cell.size()};
    }
    [[nodiscard]] QAccessible::State state() const override {
        QAccessible::State state;
        state.invalid = !isValid();
        if (isValid()) {
            state.selectable = true;
            state.focusable = true;
            state.selected = isSelected();
            state.focused = m_view->hasFocus() && m_view->currentIndex() == index();
        }
        return state;
    }
    [[nodiscard]] void* interface_cast(QAccessible::InterfaceType type) override {
        return type == QAccessible::TableCellInterface ? static_cast<QAccessibleTableCellInterface*>(this)
                                                       : nullptr;
    }

    [[nodiscard]] int columnIndex() const override { return m_column; }
    [[nodiscard]] int rowIndex() const override { return m_row; }
    [[nodiscard]] int columnExtent() const override { return 1; }
    [[nodiscard]] int rowExtent() const override { return 1; }
    [[nodiscard]] QList<QAccessibleInterface*> columnHeaderCells() const override { return {}; }
    [[nodiscard]] QList<QAccessibleInterface*> rowHeaderCells() const override { return {}; }
    [[nodiscard]] QAccessibleInterface* table() const override { return parent(); }
    [[nodiscard]] bool isSelected() const override { return m_view->selectionModel()->isSelected(index()); }

private:
    [[nodiscard]] QModelIndex index() const { return cellIn(*m_view, m_row, m_column); }

    QPointer<PacketView> m_view;
    int m_row;
    int m_column;
};

/// Its columns cannot be selected.
class PacketTable final : public QAccessibleWidget, public QAccessibleTableInterface {
public:
    explicit PacketTable(PacketView* view) : QAccessibleWidget(view, QAccessible::Table), m_view(view) {}
    ~PacketTable() override {
        for (const auto& [place, id] : m_cells) {
            QAccessible::deleteAccessibleInterface(id);
        }
    }
    PacketTable(const PacketTable&) = delete;
    PacketTable& operator=(const PacketTable&) = delete;

    [[nodiscard]] void* interface_cast(QAccessible::InterfaceType type) override {
        return type == QAccessible::TableInterface ? static_cast<QAccessibleTableInterface*>(this)
                                                   : QAccessibleWidget::interface_cast(type);
    }
    [[nodiscard]] int childCount() const override { return rowCount() * columnCount(); }
    [[nodiscard]] QAccessibleInterface* child(int place) const override {
        return place < 0 || place >= childCount() ? nullptr
                                                  : cellAt(place / columnCount(), place % columnCount());
    }
    [[nodiscard]] QAccessibleInterface* childAt(int x, int y) const override {
        const QModelIndex at = m_view->indexAt(m_view->viewport()->mapFromGlobal(QPoint(x, y)));
        const std::vector<int> columns = shownColumns(*m_view);
        const auto column = std::ranges::find(columns, at.column());
        return cellAt(at.row() - m_view->topRow(), static_cast<int>(column - columns.begin()));
    }
    [[nodiscard]] int indexOfChild(const QAccessibleInterface* child) const override {
        const auto* cell = dynamic_cast<const PacketCell*>(child);
        return cell == nullptr ? -1 : cell->rowIndex() * columnCount() + cell->columnIndex();
    }

    [[nodiscard]] QAccessibleInterface* cellAt(int row, int column) const override {
        if (!cellIn(*m_view, row, column).isValid()) {
            return nullptr;
        }
        const auto [place, isNew] = m_cells.try_emplace({row, column}, 0);
        if (isNew) {
            place->second = QAccessible::registerAccessibleInterface(new PacketCell(m_view, row, column));
        }
        return QAccessible::accessibleInterface(place->second);
    }
    [[nodiscard]] QString columnDescription(int column) const override {
        const QModelIndex cell = cellIn(*m_view, 0, column);
        return cell.isValid() ? m_view->model()->headerData(cell.column(), Qt::Horizontal).toString()
                              : QString();
    }
    [[nodiscard]] QString rowDescription(int) const override { return {}; }
    [[nodiscard]] QAccessibleInterface* caption() const override { return nullptr; }
    [[nodiscard]] QAccessibleInterface* summary() const override { return nullptr; }
    [[nodiscard]] int columnCount() const override { return static_cast<int>(shownColumns(*m_view).size()); }
    [[nodiscard]] int rowCount() const override {
        const int rows = m_view->model() == nullptr ? 0 : m_view->model()->rowCount();
        return std::clamp(rows - m_view->topRow(), 0, m_view->wholeRows());
    }

    [[nodiscard]] int selectedRowCount() const override { return static_cast<int>(selectedRows().size()); }
    [[nodiscard]] QList<int> selectedRows() const override {
        QList<int> rows;
        for (int row = 0; row < rowCount(); ++row) {
            if (isRowSelected(row)) {
                rows += row;
            }
        }
        return rows;
    }
    [[nodiscard]] bool isRowSelected(int row) const override {
        return m_view->selectionModel()->isSelected(cellIn(*m_view, row, 0));
    }
    [[nodiscard]] int selectedCellCount() const override { return selectedRowCount() * columnCount(); }
    [[nodiscard]] QList<QAccessibleInterface*> selectedCells() const override {
        QList<QAccessibleInterface*> cells;
        for (const int row : selectedRows()) {
            for (int column = 0; column < columnCount(); ++column) {
                cells += cellAt(row, column);
            }
        }
        return cells;
    }
    bool selectRow(int row) override {
        const QModelIndex at = cellIn(*m_view, row, 0);
        if (at.isValid()) {
            m_view->showRow(at.row());
        }
        return at.isValid();
    }
    bool unselectRow(int) override { return false; }
    [[nodiscard]] int selectedColumnCount() const override { return 0; }
    [[nodiscard]] QList<int> selectedColumns() const override { return {}; }
    [[nodiscard]] bool isColumnSelected(int) const override { return false; }
    bool selectColumn(int) override { return false; }
    bool unselectColumn(int) override { return false; }
    /// Cells are places: what is there is read when it is asked for.
    void modelChange(QAccessibleTableModelChangeEvent*) override {}

private:
    PacketView* m_view;
    mutable std::map<std::pair<int, int>, QAccessible::Id> m_cells; ///< no more than were ever in sight
};

QAccessibleInterface* makePacketTable(const QString& /*className*/, QObject* object) {
    auto* view = qobject_cast<PacketView*>(object);
    return view == nullptr ? nullptr : new PacketTable(view);
}

} // namespace

void installPacketAccessible() {
    static const bool isInstalled = (QAccessible::installFactory(makePacketTable), true);
    static_cast<void>(isInstalled);
}

} // namespace posewire::gui
