// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QHeaderView>
#include <QList>

#include <vector>

namespace posewire::gui {

/// The column titles of a table whose columns are as wide as their content may become. One column takes the
/// room left; where not all fit, some give way, until the operator chooses columns in the menu of the header.
class FittingHeader final : public QHeaderView {
    Q_OBJECT

public:
    explicit FittingHeader(QWidget* table);

    /// One sample for each column, as long as its content may become; an empty one takes the room left.
    void setSamples(std::vector<QString> samples);
    /// Columns that say nothing are left out altogether.
    void setUseful(int column, bool isUseful);
    /// Where not all columns fit, these give way to the one that takes the room left, the first one first.
    void setGivingWay(std::vector<int> columns);
    /// The columns that the operator chose; empty for as many as fit.
    [[nodiscard]] const QList<int>& chosen() const { return m_chosen; }
    void setChosen(const QList<int>& columns);

    /// Shares a width out among the columns.
    void fit(int width);
    /// The next column that is shown; the same one at the end.
    [[nodiscard]] int columnBeside(int column, int direction) const;

private:
    [[nodiscard]] std::vector<bool> shownColumns(int open) const;
    [[nodiscard]] int leastOpenWidth() const;
    [[nodiscard]] int sampleWidth(int column) const;
    void openMenu(const QPoint& at);

    std::vector<QString> m_samples;
    std::vector<int> m_givingWay;
    QList<int> m_useless;
    QList<int> m_chosen;
    int m_width = 0; ///< as it was last shared out
    bool m_isFitting = false;
};

} // namespace posewire::gui
