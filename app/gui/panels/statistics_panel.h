// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/base/program_state.h"
#include "app/gui/models/column.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/statistics_model.h"
#include "app/gui/panels/range_bar.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

#include <QAction>
#include <QSplitter>
#include <Qt>

#include <set>

namespace posewire::gui {

/// Dock `statistics`: the range of time, figures of every stream in it, and below them those of this
/// computer.
class StatisticsPanel : public Panel {
    Q_OBJECT

public:
    StatisticsPanel(model::SessionView& view, Commands& commands, const ReceivingState& receiving,
                    const MonitorHealth& health, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override { return m_table->columns().state(); }
    void restoreState(const QJsonObject& state) override { m_table->columns().restore(state); }

    /// Shows the packets that a cell counts in the dock of packets.
    void showPackets(const QModelIndex& index, PacketLook look = PacketLook::InContext);
    void filterToRange();

private:
    void select(const QModelIndex& index);
    void addActions(QMenu& menu, const QModelIndex& index);

    StatisticsModel m_streams{m_view};
    std::set<log::SenderId> m_folded; ///< senders that had ended
    PropertyModel m_computer;
    RangeBar* m_range = new RangeBar(m_view, m_commands, this);
    TableView* m_table = new TableView(tr("Statistics of streams"), this);
    TableView* m_facts = new TableView(tr("This computer"), this);
    QAction* m_filterToRange = new QAction(tr("Show only the packets of this range"), this);
    QSplitter* m_parts = new QSplitter(Qt::Vertical, this);
    PassingMessage* m_message = footMessage(this);
};

} // namespace posewire::gui
