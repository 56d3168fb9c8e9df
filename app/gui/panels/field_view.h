// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/field_model.h"
#include "app/gui/panels/table_view.h"

#include <functional>
#include <set>
#include <string>

namespace posewire::gui {

class Commands;

/// The tree of fields. What is open, what is selected and where it is scrolled to stay while packets change.
class FieldView : public TableView {
    Q_OBJECT

public:
    FieldView(FieldModel& model, Commands& commands, QWidget* parent);

    /// Marks the row of a node, or the nearest one around it that is open; -1 for none.
    void setHovered(std::int32_t node);

    /// Makes a node current without a signal, opens what is around it and shows it.
    void setCurrentNode(std::int32_t node);
    [[nodiscard]] std::int32_t currentNode() const;

    /// Carries out a change of the model's packets.
    void change(const std::function<void()>& carryOut);

    /// Opens the lists of a packet of a type that was not shown before.
    void openFirst();

    /// Filters and copies of the current node; nothing without one. Returns when the menu is closed.
    void showMenu(const QPoint& at);

signals:
    void nodeEntered(std::int32_t node); ///< -1 when the pointer leaves
    void nodeSelected(std::int32_t node);

protected:
    void drawRow(QPainter* painter, const QStyleOptionViewItem& option,
                 const QModelIndex& index) const override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    bool viewportEvent(QEvent* event) override;

private:
    void addFilters(QMenu& menu);
    void restore(const QModelIndex& parent);
    [[nodiscard]] std::string pathOf(const QModelIndex& index) const {
        return m_fields.document().tree.path(m_fields.node(index));
    }

    FieldModel& m_fields;
    Commands& m_commands;
    std::set<std::string> m_open;
    std::string m_currentPath;
    QModelIndex m_hovered;
    bool m_isChanging = false;
    bool m_wasReset = false;
};

} // namespace posewire::gui
