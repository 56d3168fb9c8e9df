// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/panels/filter_line.h"
#include "app/gui/panels/plots_view.h"
#include "app/gui/theme/widgets.h"

class QAction;

namespace posewire::gui {

/// Docks `plots` and `plots2`: curves of any field over the session's time.
class PlotsPanel : public Panel {
    Q_OBJECT

public:
    /// `parent` has the dock's name already: only the first of the docks has what others ask for.
    PlotsPanel(model::SessionView& view, Commands& commands, Playback& playback, QWidget* parent);

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override { return m_plots->curves().state(); }
    void restoreState(const QJsonObject& state) override;

    void add(const QStringList& curves, std::optional<std::size_t> chart = {});
    void removeAll();
    void zoomIn() { m_plots->zoom(0.5); }
    void zoomOut() { m_plots->zoom(2); }
    void showAll() { m_plots->fit(); }
    void showRange() { m_plots->fitRange(); }
    /// Asks where to.
    void save();
    void saveSet();
    void openSet();

    /// Writes what is in view as PNG, SVG, PDF or CSV, as the path ends. Returns what went wrong, empty for
    /// nothing.
    [[nodiscard]] QString saveTo(const QString& path);
    /// Reads curves that saveSet() wrote; likewise.
    [[nodiscard]] QString openFrom(const QString& path);

private:
    void layOut();
    void showChanged();
    void showMenu(const QPoint& place, const QPoint& onScreen);
    void addCurveEntries(QMenu& menu, const PlotsView::Spot& spot, const QPoint& place);

    PlotsView* m_plots;
    QLabel* m_problem = plainLabel(this);
    FilterLine* m_line;
    CommandBar* m_bar = new CommandBar(this);
    PassingMessage* m_message = footMessage(this);
    QAction* m_live;
    QAction* m_range;
};

} // namespace posewire::gui
