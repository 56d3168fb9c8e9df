// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractItemView>
#include <QHeaderView>
#include <QJsonObject>
#include <QStringList>

#include <vector>

class QAbstractButton;
class QMenu;

namespace posewire::gui {

/// The column titles of a table whose columns are as wide as their content may become. One column takes the
/// room left; where not all fit, some give way, until the operator chooses columns in the menu of the header.
class FittingHeader final : public QHeaderView {
    Q_OBJECT

public:
    /// The column that is always shown: the first, which carries a tree, or the one that takes the room left.
    enum class Kept { First, Open };

    /// `font` is that of the cells; a cell has `room` pixels beside its text and margins.
    FittingHeader(QAbstractItemView* table, QFont (*font)(), int room, Kept kept);

    /// One sample for each column, as long as its content may become; an empty one takes the room left, but
    /// never less than `leastOpen` needs, or 22 characters without it.
    void setSamples(std::vector<QString> samples, const QString& leastOpen = {});
    /// Makes the column that takes the room left never narrower than `text` needs, where it would be.
    void keepOpenFor(const QString& text);
    /// Makes the column that takes the room left as wide as `text` needs before elastic ones get wider.
    void wishOpenFor(const QString& text);
    /// Makes columns of figures, but elastic ones, as wide as what stands in the first level of rows, where
    /// they are not: a figure that is cut would be another one. Once there, the width stays.
    void keepFigures();
    /// Columns that say nothing are left out altogether.
    void setUseful(int column, bool isUseful);
    /// Where not all columns fit, these give way to the one that takes the room left, the first one first.
    /// From now on the operator can choose columns.
    void setGivingWay(std::vector<int> columns);
    /// A column that gets narrower, down to what `least` needs, where even the columns that are left do not
    /// fit; and wider, up to what `most` needs, where there is room left. The one added first comes first.
    /// Down to what `soon` needs it gets before any other column gives way.
    void addElastic(int column, const QString& least, const QString& most, const QString& soon = {});
    /// Makes it never give way soon by so much that `text` does not fit, where it would.
    void keepElasticFor(int column, const QString& text);
    [[nodiscard]] bool isChoosable() const { return !m_givingWay.empty(); }
    /// Without a choice of the operator only these are shown, as they fit.
    void setUsual(std::vector<int> columns);
    /// The columns that the operator chose, by their titles as they were at first; none for the usual ones.
    /// What no column is called is left out.
    void setChosen(const QStringList& columns);
    /// The same as a panel keeps it: "columns", or nothing where the operator chose none.
    [[nodiscard]] QJsonObject state() const;
    void restore(const QJsonObject& state);
    /// One entry for each column that can be chosen.
    void addColumnActions(QMenu& menu);

    /// Makes columns as wide as their samples and shares out the rest.
    void measure();
    /// Shares out the width of the table; widths that the operator dragged stay.
    void fit();
    /// Where the words of the last title in sight end, in pixels from the left.
    [[nodiscard]] int titlesEnd() const;
    /// Puts a button at the end of the line of titles, with the first of these words that cover none of them.
    /// False where all would: it has the first words then, and covers one.
    bool seat(QAbstractButton& button, const QStringList& words) const;
    /// The next column that is shown; the same one at the end.
    [[nodiscard]] int columnBeside(int column, int direction) const;
    /// Columns are not yet as wide as they will be.
    [[nodiscard]] bool isFitting() const { return m_isFitting; }

signals:
    void fitted();

private:
    struct Elastic {
        int column;
        QString least;
        QString most;
        QString soon;
    };

    void shareOut(int open);
    void fitElastic(int spare);
    [[nodiscard]] int columns() const { return static_cast<int>(m_samples.size()); }
    [[nodiscard]] int openColumn() const;
    [[nodiscard]] bool isWanted(int column) const;
    [[nodiscard]] bool isElastic(int column) const;
    [[nodiscard]] bool isOfFigures(int column) const;
    [[nodiscard]] int textWidth(const QString& text) const;
    [[nodiscard]] int sampleWidth(int column) const;
    /// Of one that gets narrower soon, when it has.
    [[nodiscard]] int soonWidth(int column) const;
    [[nodiscard]] int leastOpenWidth() const;
    void choose(int column, bool isShown);

    QAbstractItemView* m_table;
    QFont (*m_font)();
    int m_room;
    Kept m_kept;
    std::vector<QString> m_samples;
    QString m_leastOpen;
    QString m_wishedOpen;
    std::vector<int> m_givingWay;
    std::vector<Elastic> m_elastic;
    QList<int> m_useless;
    std::vector<int> m_usual; ///< empty for all
    QStringList m_names;      ///< by column
    QStringList m_chosen;
    bool m_isFitting = false;
};

} // namespace posewire::gui
