// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/tracker_model.h"
#include "app/gui/panel.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/panels/tracker_plots.h"

#include <QSplitter>
#include <QStackedLayout>

namespace posewire::gui {

/// Dock `trackers`: all trackers of the shown character, and one of them closely, with its last ten seconds.
class TrackersPanel : public Panel {
    Q_OBJECT

public:
    TrackersPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override;
    void restoreState(const QJsonObject& state) override;

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void layOut();
    void followSelection();
    void select(const QModelIndex& index);

    model::SessionView& m_view;
    Commands& m_commands;
    TrackerModel m_trackers;
    PropertyModel m_facts;
    QSplitter* m_splitter;
    TableView* m_table;
    QWidget* m_detail;
    TableView* m_factTable;
    TimePlot* m_plots;
    bool m_isFollowing = false;
    bool m_isDivided = false; ///< from then on the operator's division counts
};

} // namespace posewire::gui
