// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractItemView>
#include <QHeaderView>
#include <QJsonObject>
#include <QStringList>

#include <map>
#include <vector>

class QAbstractButton;
class QMenu;

namespace posewire::gui {

struct ColumnRoom;

/// The column titles of a table. Columns are as wide as the model's ColumnRoom says and as the figures in
/// sight need; where not all fit, some leave, until the operator chooses columns in the menu of the header.
class FittingHeader final : public QHeaderView {
    Q_OBJECT

public:
    struct Share;
    /// The column that is always shown: the first, which carries a tree, or the one that takes the room left.
    enum class Kept { First, Open };

    /// `font` is that of the cells; a cell has `space` pixels beside its text and margins.
    FittingHeader(QAbstractItemView* table, QFont (*font)(), int space, Kept kept);

    void setModel(QAbstractItemModel* model) override;

    [[nodiscard]] bool isChoosable() const;
    /// The columns that the operator chose, by their titles as they were at first; none for the usual ones.
    /// Titles of no column are left out.
    void setChosen(const QStringList& columns);
    /// The chosen columns as a panel saves them, under "columns"; empty if the operator chose none.
    [[nodiscard]] QJsonObject state() const;
    void restore(const QJsonObject& state);
    /// One entry for each column that can be chosen.
    void addColumnActions(QMenu& menu);

    /// Shares out the width of the table; widths that the operator dragged stay.
    void fit();
    /// Makes columns wider whose figures, or words that are to be whole, are cut in a row or in those in
    /// sight: a figure that is cut would be another one. Once there, the width stays.
    void keepWhole(const QModelIndex& row);
    void keepWhole();
    /// In pixels from the left.
    [[nodiscard]] int titlesEnd() const;
    /// Puts a button at the end of the line of titles, with the first of these words that cover none of them.
    /// False if all would: it has the first words then, and covers one.
    bool seat(QAbstractButton& button, const QStringList& words) const;
    /// The next column that is shown; the same one at the end.
    [[nodiscard]] int columnBeside(int column, int direction) const;
    /// Columns are not yet as wide as they will be.
    [[nodiscard]] bool isFitting() const { return m_isFitting; }

signals:
    void fitted();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    [[nodiscard]] ColumnRoom room(int column) const;
    [[nodiscard]] Share share(int column) const;
    [[nodiscard]] bool isWanted(int column) const;
    [[nodiscard]] QString growing(const QModelIndex& cell) const;
    [[nodiscard]] bool isKept(int column) const;
    [[nodiscard]] bool isOfFigures(int column) const;
    [[nodiscard]] int textWidth(const QString& text) const;
    [[nodiscard]] int usualWidth(int column, const QString& usual) const;
    void choose(int column, bool isShown);

    QAbstractItemView* m_table;
    QFont (*m_font)();
    int m_space;
    Kept m_kept;
    QStringList m_names; ///< by column
    QStringList m_chosen;
    std::vector<QString> m_whole; ///< by column: the longest text that it was made whole for
    std::map<int, int> m_dragged; ///< widths that the operator gave
    bool m_isBare = false;        ///< no column is shown that can leave
    bool m_isFitting = false;
};

} // namespace posewire::gui
