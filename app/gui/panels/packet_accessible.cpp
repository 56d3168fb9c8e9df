// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/packet_view.h"

#include "app/gui/models/column.h"
#include "app/gui/panels/fitting_header.h"

#include <QAccessible>
#include <QAccessibleWidget>
#include <QPointer>

#include <algorithm>
#include <map>

namespace posewire::gui {

namespace {

/// Columns that are shown, in order.
std::vector<int> shownColumns(const PacketView& view) {
    std::vector<int> columns;
    for (int column = 0; column < view.header().count(); ++column) {
        if (!view.header().isSectionHidden(column)) {
            columns.push_back(column);
        }
    }
    return columns;
}

/// What is at a place in sight; invalid where that is empty by now.
QModelIndex indexAt(const PacketView& view, int row, int column) {
    const std::vector<int> columns = shownColumns(view);
    return row >= 0 && row < view.rowsInSight() && column >= 0 && column < static_cast<int>(columns.size())
               ? view.model()->index(view.firstInSight() + row, columns[static_cast<std::size_t>(column)])
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
        const QModelIndex at = m_view == nullptr ? QModelIndex() : index();
        if (text != QAccessible::Name || !at.isValid()) {
            return {};
        }
        const QString spoken = at.data(Qt::AccessibleTextRole).toString();
        return spoken.isEmpty() ? cellText(at) : spoken;
    }
    void setText(QAccessible::Text, const QString&) override {}
    [[nodiscard]] QRect rect() const override {
        const QRect cell = m_view->visualRect(index());
        return {m_view->viewport()->mapToGlobal(cell.topLeft()), cell.size()};
    }
    [[nodiscard]] QAccessible::State state() const override {
        QAccessible::State state;
        state.invalid = !isValid();
        if (!state.invalid) {
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
    [[nodiscard]] QModelIndex index() const { return indexAt(*m_view, m_row, m_column); }

    QPointer<PacketView> m_view;
    int m_row;
    int m_column;
};

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
        const int columns = columnCount();
        return columns == 0 || place < 0 ? nullptr : cellAt(place / columns, place % columns);
    }
    [[nodiscard]] QAccessibleInterface* childAt(int x, int y) const override {
        const QModelIndex at = m_view->indexAt(m_view->viewport()->mapFromGlobal(QPoint(x, y)));
        const std::vector<int> columns = shownColumns(*m_view);
        const auto column = std::ranges::find(columns, at.column());
        return at.isValid() && column != columns.end()
                   ? cellAt(at.row() - m_view->firstInSight(), static_cast<int>(column - columns.begin()))
                   : nullptr;
    }
    [[nodiscard]] int indexOfChild(const QAccessibleInterface* child) const override {
        const auto* cell = dynamic_cast<const PacketCell*>(child);
        return cell == nullptr ? -1 : cell->rowIndex() * columnCount() + cell->columnIndex();
    }

    [[nodiscard]] QAccessibleInterface* cellAt(int row, int column) const override {
        if (!gui::indexAt(*m_view, row, column).isValid()) {
            return nullptr;
        }
        const auto [place, isNew] = m_cells.try_emplace({row, column}, 0);
        if (isNew) {
            place->second = QAccessible::registerAccessibleInterface(new PacketCell(m_view, row, column));
        }
        return QAccessible::accessibleInterface(place->second);
    }
    [[nodiscard]] QString columnDescription(int column) const override {
        const std::vector<int> columns = shownColumns(*m_view);
        return column >= 0 && column < static_cast<int>(columns.size())
                   ? m_view->model()
                         ->headerData(columns[static_cast<std::size_t>(column)], Qt::Horizontal)
                         .toString()
                   : QString();
    }
    [[nodiscard]] QString rowDescription(int) const override { return {}; }
    [[nodiscard]] QAccessibleInterface* caption() const override { return nullptr; }
    [[nodiscard]] QAccessibleInterface* summary() const override { return nullptr; }
    [[nodiscard]] int columnCount() const override { return static_cast<int>(shownColumns(*m_view).size()); }
    [[nodiscard]] int rowCount() const override { return m_view->rowsInSight(); }

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
        const QModelIndex at = gui::indexAt(*m_view, row, 0);
        return at.isValid() && m_view->selectionModel()->isSelected(at);
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
        const QModelIndex at = gui::indexAt(*m_view, row, 0);
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
    static const bool isInstalled = [] {
        QAccessible::installFactory(makePacketTable);
        return true;
    }();
    static_cast<void>(isInstalled);
}

} // namespace posewire::gui
