// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/tracker_model.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/plots/time_plot.h"

#include <QSplitter>
#include <QWidget>
#include <Qt>

namespace posewire::gui {

/// Dock `trackers`: all trackers of the shown character, and one of them closely, with its last ten seconds.
class TrackersPanel : public Panel {
    Q_OBJECT

public:
    TrackersPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override { return m_table->columns().state(); }
    void restoreState(const QJsonObject& state) override { m_table->columns().restore(state); }

private:
    void select(const QModelIndex& index);
    [[nodiscard]] QStringList curvesOf(const QModelIndex& cell) const;
    void addPlots(QMenu& menu, const QModelIndex& index);

    TrackerModel m_trackers{m_view};
    PropertyModel m_facts;
    QSplitter* m_splitter = new QSplitter(Qt::Vertical, this);
    TableView* m_table = new TableView(tr("Trackers"), this);
    QWidget* m_detail = new QWidget(this);
    TableView* m_factTable = new TableView(tr("Selected tracker"), this);
    TimePlot* m_plots;
    bool m_isFollowing = false;
    bool m_isDivided = false; ///< from then on the operator's division counts
};

} // namespace posewire::gui
