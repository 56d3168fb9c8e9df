// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/panels/fitting_header.h"

#include <QTreeView>

#include <functional>

class QMenu;
class QMimeData;

namespace posewire::gui {

void drawEmptyText(QWidget& view, const QString& text);
/// The lines of it from the first on that have room, wrapped; the first one cut where even that has none.
[[nodiscard]] QString fittingLines(const QFontMetrics& metrics, const QString& text, const QSizeF& room);

/// The one way in which docks show a model: rows of the theme's height, cells by CellDelegate, columns by
/// FittingHeader, a sentence if there are no rows, copying by keyboard and menu.
class TableView : public QTreeView {
    Q_OBJECT

public:
    /// `name` is what screen readers call the table.
    explicit TableView(const QString& name, QWidget* parent = nullptr);

    [[nodiscard]] FittingHeader& columns() const { return *m_columns; }
    void setModel(QAbstractItemModel* model) override;
    /// Shows a list of properties, without column titles.
    void showFacts(QAbstractItemModel& facts);
    void fixHeight();

    /// From now on, opens what is inserted on the first two levels of a tree, with all under it. What comes
    /// below those is left as it is: whether it shows is up to the operator by then.
    void expandNew();

    /// What to do where the table is empty: shown while it has no rows, and its description for screen
    /// readers then.
    void setEmptyText(const QString& text);

    /// From now on rows can be dragged as what `dragged` makes of them: null for those that cannot.
    void setDragged(std::function<QMimeData*(const QModelIndex& index)> dragged);

    [[nodiscard]] int heightForRows(int rows) const;

    /// Rows as lines, cells set apart by tabs: what the copy commands give.
    [[nodiscard]] QString rowText(const QModelIndex& index) const;
    [[nodiscard]] QString allText() const;

signals:
    /// The menu of a row, or of none, is about to be shown; what is added to it comes first.
    void menuRequested(QMenu& menu, const QModelIndex& index);

protected:
    void paintEvent(QPaintEvent* event) override;
    /// Repaints the cells that changed. Models announce one change a tick, for the rows of the first level;
    /// rows below them may have changed as well.
    void dataChanged(const QModelIndex& topLeft, const QModelIndex& bottomRight,
                     const QList<int>& roles = {}) override;
    void startDrag(Qt::DropActions actions) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    void addRows(QString& text, const QModelIndex& parent) const;
    void addCopying(QMenu& menu, const QModelIndex& index);
    void copy(const QString& text);
    void describe();

    FittingHeader* m_columns;
    QString m_emptyText;
    std::function<QMimeData*(const QModelIndex& index)> m_dragged;
};

} // namespace posewire::gui
