// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/tracker_history.h"

#include <QWidget>

#include <utility>
#include <vector>

class QCustomPlot;
class QCPGraph;
class QCPItemRect;
class QCPLayoutElement;
class QCPAxisRect;
class QCPTextElement;

namespace posewire::gui {

/// The last ten seconds of a tracker: free acceleration x y z above, norm of the magnetic field below, on one
/// time axis that ends at the cursor. Where samples are missing, curves break; the gap is hatched, or marked
/// at the bottom where it is too short for that.
class TrackerPlots : public QWidget {
    Q_OBJECT

public:
    explicit TrackerPlots(QWidget* parent = nullptr);

    void show(const TrackerHistory& history);

    [[nodiscard]] QSize minimumSizeHint() const override;
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void changeEvent(QEvent* event) override;

private:
    void applyColours();
    void replot();
    void addTitle(int row, const QString& text);
    [[nodiscard]] QCPAxisRect* addAxes(int row);
    using Gap = std::pair<double, double>; ///< from, to (s)
    void mark(const std::vector<Gap>& gaps);
    void hatch(const std::vector<Gap>& gaps);

    QCustomPlot* m_plot;
    std::vector<QCPTextElement*> m_titles;
    std::vector<QCPAxisRect*> m_axes;
    std::vector<QCPGraph*> m_graphs; ///< x, y, z, norm
    QCPGraph* m_marks = nullptr;     ///< gaps too short to be hatched
    std::vector<QCPItemRect*> m_hatches;
};

} // namespace posewire::gui
