// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/panels/fitting_header.h"

#include <QAbstractItemView>
#include <QPushButton>
#include <QScrollBar>

namespace posewire::gui {

/// Of equal width, and a little smaller than the window's.
[[nodiscard]] QFont packetFont();

/// A table for tens of millions of rows that all have one height: its cost does not grow with the number of
/// rows. Follows the last row until it is scrolled away, and then shows how many have come since.
class PacketView : public QAbstractItemView {
    Q_OBJECT

public:
    /// `name` is what screen readers call the table.
    explicit PacketView(const QString& name, QWidget* parent = nullptr);

    /// What to do if the table is empty: its description for screen readers, shown while it has no rows.
    void setEmptyText(const QString& text);

    [[nodiscard]] bool isFollowing() const { return m_isFollowing; }
    /// Goes to the last row and stays with it as rows come; or stops where it is.
    void setFollowing(bool isFollowing);
    /// While rows come that a filter found among what was there before: they are not new.
    void setCatchingUp(bool isCatchingUp) { m_isCatchingUp = isCatchingUp; }
    /// Makes a row the current and only selected one and shows it.
    void showRow(int row);
    [[nodiscard]] bool isShown(const QModelIndex& index) const;
    [[nodiscard]] int topRow() const { return verticalScrollBar()->value(); }
    [[nodiscard]] int wholeRows() const { return std::max(1, viewport()->height() / m_rowHeight); }
    [[nodiscard]] FittingHeader& header() const { return *m_header; }

    void setModel(QAbstractItemModel* model) override;
    [[nodiscard]] QRect visualRect(const QModelIndex& index) const override;
    void scrollTo(const QModelIndex& index, ScrollHint hint = EnsureVisible) override;
    [[nodiscard]] QModelIndex indexAt(const QPoint& point) const override;
    /// Does nothing: rows are found with the pointer and the arrows, not by typing.
    void keyboardSearch(const QString& /*search*/) override {}

signals:
    void newestRequested();
    void menuRequested(const QPoint& globalPosition);

protected:
    /// When a dialog or a menu is closed the base selects a row; this selects none.
    void focusInEvent(QFocusEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void scrollContentsBy(int dx, int dy) override;
    void updateGeometries() override;
    [[nodiscard]] QModelIndex moveCursor(CursorAction action, Qt::KeyboardModifiers modifiers) override;
    [[nodiscard]] int horizontalOffset() const override { return m_header->offset(); }
    [[nodiscard]] int verticalOffset() const override { return 0; }
    [[nodiscard]] bool isIndexHidden(const QModelIndex& /*index*/) const override { return false; }
    void setSelection(const QRect& rect, QItemSelectionModel::SelectionFlags flags) override;
    /// The base would look at each row that changed, which may be millions.
    void dataChanged(const QModelIndex& /*topLeft*/, const QModelIndex& /*bottomRight*/,
                     const QList<int>& /*roles*/ = {}) override {
        viewport()->update();
    }
    [[nodiscard]] QRegion visualRegionForSelection(const QItemSelection& /*selection*/) const override {
        return viewport()->rect();
    }

private:
    [[nodiscard]] int rowCount() const { return model() == nullptr ? 0 : model()->rowCount(); }
    void layOut();
    void paintRow(QPainter& painter, int row) const;

    FittingHeader* m_header;
    QString m_emptyText;
    QPushButton* m_newest = new QPushButton(this);
    int m_rowHeight = 1;
    bool m_isFollowing = true;
    bool m_isAdjusting = false; ///< the scroll bar moves because rows come or go, not because anybody scrolls
    bool m_isCatchingUp = false;
    std::uint64_t m_missed = 0; ///< rows that came while not following
};

/// From now on screen readers find in a PacketView the rows that are in sight, with the titles of their
/// columns, and in each cell what it says at that moment. Rows out of sight, which may be tens of millions,
/// are not there until they are scrolled to.
void installPacketAccessible();

} // namespace posewire::gui
