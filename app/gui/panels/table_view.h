// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QJsonArray>
#include <QTreeView>

#include <vector>

class QMenu;

namespace posewire::gui {

/// What to do where a list is empty, in the middle of its viewport.
void drawEmptyText(QWidget& view, const QString& text);

/// The one way in which docks show a model: rows of the theme's height, cells by CellDelegate, columns as
/// wide as a sample of their content, a sentence where there are no rows, copying by keyboard and
/// menu.
class TableView : public QTreeView {
    Q_OBJECT

public:
    /// `name` is what screen readers call the table.
    explicit TableView(const QString& name, QWidget* parent = nullptr);

    /// One sample for each column, as long as its content may become; an empty one takes the room left, but
    /// never less than `leastOpen` needs.
    void setColumnSamples(std::vector<QString> samples, const QString& leastOpen = {});

    /// From this column on, those that do not fit are left out, as long as the operator has not chosen
    /// columns by the menu of the header.
    void setOptionalColumns(int first);

    /// The columns that the operator chose; empty for as many as fit.
    [[nodiscard]] QJsonArray chosenColumns() const;
    void setChosenColumns(const QJsonArray& columns);

    /// From now on, opens what is inserted on the first two levels of a tree, with all under it. What comes
    /// below those is left as it is: whether it shows is up to the operator by then.
    void expandNew();

    /// What to do where the table is empty.
    void setEmptyText(const QString& text);
    [[nodiscard]] const QString& emptyText() const { return m_emptyText; }

    /// Height that shows `rows` rows and the header.
    [[nodiscard]] int heightForRows(int rows) const;

    /// Rows as lines, cells set apart by tabs: what the copy commands give.
    [[nodiscard]] QString rowText(const QModelIndex& index) const;
    [[nodiscard]] QString allText() const;

signals:
    void copyRequested(const QString& text);
    /// The menu of a row, or of none, is about to be shown; what is added to it comes first.
    void menuRequested(QMenu& menu, const QModelIndex& index);

protected:
    void paintEvent(QPaintEvent* event) override;
    /// Models announce one change a tick, by the rows of the first level; those below have changed as well.
    void dataChanged(const QModelIndex& topLeft, const QModelIndex& bottomRight,
                     const QList<int>& roles = {}) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void fitColumns();
    void fitOpenColumn();
    void leaveOutWhatDoesNotFit(int open);
    void showHeaderMenu(const QPoint& at);
    void addColumnActions(QMenu& menu);
    void chooseColumn(int column, bool isShown);
    [[nodiscard]] int textWidth(const QString& text) const;
    [[nodiscard]] int sampleWidth(int column) const;
    void addRows(QString& text, const QModelIndex& parent) const;

    std::vector<QString> m_samples;
    QString m_leastOpen;
    int m_firstOptional = -1;
    bool m_isChosen = false;
    QString m_emptyText;
};

} // namespace posewire::gui
